// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/roughness.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/film/flow_factors.hpp"

namespace clatter::film {

RoughFilm::RoughFilm(const RoughnessOptions& options) : options_(options) {
  if (!(options.piston >= 0.0) || !(options.liner >= 0.0))
    throw InputError(fmt::format("roughness: found {} m and {} m, expected >= 0", options.piston,
                                 options.liner));
  sigma_ = std::hypot(options.piston, options.liner);
  if (!options.flow_factors) {
    if (options.stress_factors) throw InputError("friction_factors: need flow_factors");
    return;
  }
  if (sigma_ == 0.0)
    throw InputError("flow_factors: need a roughness above 0: both walls are smooth");
  // A product, not a difference of squares, which a fused multiply-add leaves above 0 for equal
  // walls (hard case N5).
  share_difference_ =
      (options.piston - options.liner) * (options.piston + options.liner) / (sigma_ * sigma_);
  pressure_flow_factor(1.0, options.peklenik);
  if (share_difference_ != 0.0) shear_flow_factor(1.0, options.peklenik);
}

void RoughFilm::thicknesses(const Eigen::ArrayXd& h, FilmCells& film) const {
  if (sigma_ == 0.0) {
    film.set_smooth(h);
    return;
  }
  for (Eigen::Index i = 0; i < h.size(); ++i) {
    const ValueSlope gap = mean_gap(h[i], sigma_);
    film.content[i] = film.flow_angle[i] = film.flow_axial[i] = film.carry[i] = gap.value;
    film.d_content[i] = film.d_flow_angle[i] = film.d_flow_axial[i] = film.d_carry[i] = gap.slope;
    if (options_.flow_factors) apply_factors(h[i], static_cast<int>(i), film);
  }
}

// Each thickness follows its law down to the end of the fit's range, and below that h_T, scaled to
// the value there.
void RoughFilm::apply_factors(double h, int cell, FilmCells& film) const {
  const ValueSlope h_t{film.content[cell], film.d_content[cell]};
  auto set = [&](double peklenik, const auto& law, double& out, double& d_out) {
    const double lowest = lowest_ratio(peklenik) * sigma_;
    if (h < lowest) {
      const ValueSlope end = mean_gap(lowest, sigma_);
      const double value = law(lowest, end).value;
      out = value * h_t.value / end.value;
      d_out = value * h_t.slope / end.value;
    } else {
      const ValueSlope thickness = law(h, h_t);
      out = thickness.value;
      d_out = thickness.slope;
    }
  };
  auto flow = [&](double peklenik, double& out, double& d_out) {
    const auto law = [&](double at, const ValueSlope&) -> ValueSlope {
      const double ratio = at / sigma_;
      const ValueSlope phi = pressure_flow_factor(ratio, peklenik);
      const double root = std::cbrt(phi.value);
      return {at * root, root + ratio * phi.slope * root / (3.0 * phi.value)};
    };
    set(peklenik, law, out, d_out);
  };
  flow(options_.peklenik, film.flow_axial[cell], film.d_flow_axial[cell]);
  flow(1.0 / options_.peklenik, film.flow_angle[cell], film.d_flow_angle[cell]);
  if (share_difference_ == 0.0) return;
  const auto carry = [&](double at, const ValueSlope& mean) -> ValueSlope {
    const ValueSlope shear = shear_flow_factor(at / sigma_, options_.peklenik);
    return {mean.value - sigma_ * share_difference_ * shear.value,
            mean.slope - share_difference_ * shear.slope};
  };
  set(options_.peklenik, carry, film.carry[cell], film.d_carry[cell]);
}

void RoughFilm::shear(const Eigen::ArrayXd& h, const FilmCells& film, ShearThickness& shear) const {
  shear.lever = film.content;
  shear.lever_slope = film.d_content;
  if (!options_.flow_factors) {
    shear.inverse = film.content.inverse();
    shear.inverse_slope = -film.d_content * shear.inverse.square();
    return;
  }
  for (Eigen::Index i = 0; i < h.size(); ++i) {
    const ValueSlope mean = mean_inverse_gap(h[i] / sigma_);
    shear.inverse[i] = mean.value / sigma_;
    shear.inverse_slope[i] = mean.slope / (sigma_ * sigma_);
    if (options_.stress_factors) add_stress_factors(h[i], static_cast<int>(i), shear);
  }
}

// Both continue below their ranges: phi_fs / H as it is there, phi_fp h in proportion to h_T.
void RoughFilm::add_stress_factors(double h, int cell, ShearThickness& shear) const {
  const double ratio = h / sigma_, at = std::max(ratio, lowest_ratio(3.0));
  const ValueSlope fs = shear_stress_factor(at, options_.peklenik);
  shear.inverse[cell] += fs.value / (at * sigma_);
  if (ratio >= at) shear.inverse_slope[cell] += (fs.slope - fs.value / at) / (at * sigma_ * sigma_);
  const double lowest = lowest_stress_ratio(options_.peklenik);
  const ValueSlope h_t{shear.lever[cell], shear.lever_slope[cell]};
  ValueSlope own;
  if (ratio < lowest) {
    const double share = pressure_stress_factor(lowest, options_.peklenik).value * lowest * sigma_ /
                         mean_gap(lowest * sigma_, sigma_).value;
    own = {share * h_t.value, share * h_t.slope};
  } else {
    const ValueSlope fp = pressure_stress_factor(ratio, options_.peklenik);
    own = {fp.value * h, fp.value + ratio * fp.slope};
  }
  const double piston = 0.5 * (1.0 + share_difference_), liner = 0.5 * (1.0 - share_difference_);
  shear.lever[cell] = piston * own.value + liner * (2.0 * h_t.value - own.value);
  shear.lever_slope[cell] = piston * own.slope + liner * (2.0 * h_t.slope - own.slope);
}

}  // namespace clatter::film
