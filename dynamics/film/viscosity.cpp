// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/viscosity.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

constexpr double kWaltherShift = 0.7;  // [mm2/s]
constexpr double kMm2 = 1e-6;          // [m2/s]

double walther_log(double kinematic) {
  return std::log10(std::log10(kinematic / kMm2 + kWaltherShift));
}

}  // namespace

double viscosity_of(const VogelLaw& law, double temperature) {
  return law.a * std::exp(law.b / (temperature - law.c));
}

double viscosity_of(const WaltherLaw& law, double temperature) {
  const double first = walther_log(law.kinematic[0]), last = walther_log(law.kinematic[1]);
  const double share = std::log(temperature / law.temperature[0]) /
                       std::log(law.temperature[1] / law.temperature[0]);
  const double shifted = std::pow(10.0, std::pow(10.0, first + share * (last - first)));
  return law.density * (shifted - kWaltherShift) * kMm2;
}

ValueSlope shear_thinning(const CrossLaw& law, double rate) {
  const double x = std::pow(rate / law.rate, law.exponent), rest = 1.0 - law.ratio;
  return {law.ratio + rest / (1.0 + x), -rest * law.exponent * x / ((1.0 + x) * (1.0 + x))};
}

Viscosity::Viscosity(const ViscosityOptions& options, double constant)
    : options_(options), constant_(constant), reference_(constant) {
  if (!options_.by_temperature()) return;
  if (options_.temperature.empty() ||
      (options_.temperature.size() > 1 && options_.height.size() != options_.temperature.size()))
    throw InputError(
        fmt::format("viscosity: found {} temperatures and {} heights, expected one "
                    "temperature or as many heights",
                    options_.temperature.size(), options_.height.size()));
  for (const double temperature : options_.temperature) {
    const double found = at_temperature(temperature);
    const bool below = options_.vogel && !(temperature > options_.vogel->c);
    if (below || !(found > 0.0) || !std::isfinite(found))
      throw InputError(fmt::format(
          "viscosity: found {:.3g} Pa s at {:.6g} K, expected more than 0 and a temperature in the "
          "range of the law",
          found, temperature));
  }
  reference_ = at_temperature(options_.temperature.front());
  varies_ = options_.temperature.size() > 1;
}

double Viscosity::at_temperature(double temperature) const {
  if (options_.vogel) return viscosity_of(*options_.vogel, temperature);
  if (options_.walther) return viscosity_of(*options_.walther, temperature);
  return constant_;
}

double Viscosity::temperature_at(double height) const {
  const std::vector<double>&z = options_.height, &t = options_.temperature;
  if (t.size() == 1 || height <= z.front()) return t.front();
  if (height >= z.back()) return t.back();
  size_t k = 1;
  while (z[k] < height) ++k;
  return t[k - 1] + (t[k] - t[k - 1]) * (height - z[k - 1]) / (z[k] - z[k - 1]);
}

double Viscosity::at_height(double height) const {
  return varies_ ? at_temperature(temperature_at(height)) : reference_;
}

void Viscosity::ratio(const PadGrid& grid, double height, double speed, const FilmCells& film,
                      Eigen::ArrayXd& value, Eigen::ArrayXd& slope) const {
  value.setOnes(grid.size());
  slope.setZero(grid.size());
  if (varies_)
    for (int j = 0; j < grid.n_axial(); ++j) {
      const double warm = at_height(height + grid.axial(j)) / reference_;
      for (int i = 0; i < grid.n_angle(); ++i) value[grid.cell(i, j)] = warm;
    }
  if (!options_.cross || speed == 0.0) return;
  for (Eigen::Index c = 0; c < value.size(); ++c) {
    const ValueSlope thinned = shear_thinning(*options_.cross, std::abs(speed) / film.content[c]);
    // The rate is U / h_T: d ln(rate) / dh = -h_T' / h_T.
    slope[c] = -value[c] * thinned.slope * film.d_content[c] / film.content[c];
    value[c] *= thinned.value;
  }
}

double Viscosity::reduced(double pressure) const {
  const double alpha = options_.pressure_coefficient;
  return alpha > 0.0 ? -std::expm1(-alpha * pressure) / alpha : pressure;
}

bool Viscosity::pressure(const Eigen::ArrayXd& reduced, Eigen::ArrayXd& value,
                         Eigen::ArrayXd& slope) const {
  const double alpha = options_.pressure_coefficient;
  value.resize(reduced.size());
  slope.resize(reduced.size());
  for (Eigen::Index c = 0; c < reduced.size(); ++c) {
    const double part = alpha * reduced[c];
    if (!(part < 1.0)) return false;
    value[c] = -std::log1p(-part) / alpha;
    slope[c] = 1.0 / (1.0 - part);
  }
  return true;
}

void divide_conductance(const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& slope, FilmCells& film) {
  const auto divide = [&](Eigen::ArrayXd& g, Eigen::ArrayXd& d_g) {
    for (Eigen::Index c = 0; c < g.size(); ++c) {
      const double root = std::cbrt(ratio[c]);
      d_g[c] = (d_g[c] - g[c] * slope[c] / (3.0 * ratio[c])) / root;
      g[c] /= root;
    }
  };
  divide(film.flow_angle, film.d_flow_angle);
  divide(film.flow_axial, film.d_flow_axial);
}

void multiply_shear(const Eigen::ArrayXd& ratio, const Eigen::ArrayXd& slope,
                    Eigen::ArrayXd& inverse, Eigen::ArrayXd& inverse_slope) {
  inverse_slope = inverse_slope * ratio + inverse * slope;
  inverse *= ratio;
}

}  // namespace clatter::film
