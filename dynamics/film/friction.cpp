// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {

Friction::Friction(const FrictionOptions& options, int cells)
    : options_(options),
      force_(cells),
      gap_slope_(cells),
      film_slope_(cells),
      speed_slope_(cells),
      height_slope_(cells),
      share_(Eigen::ArrayXd::Ones(cells)),
      share_slope_(Eigen::ArrayXd::Zero(cells)) {
  if (!(options.coefficient >= 0.0) || !(options.reversal_speed > 0.0))
    throw InputError(
        fmt::format("friction: found coefficient {}, reversal speed {} m/s, expected >= 0 and > 0",
                    options.coefficient, options.reversal_speed));
  clear();
}

void Friction::clear(const Cover* cover) {
  for (Eigen::ArrayXd* values : {&force_, &gap_slope_, &film_slope_, &speed_slope_, &height_slope_})
    values->setZero();
  if (cover == nullptr) return;
  const Eigen::Index columns = force_.size() / cover->share.size();
  share_ = cover->share.replicate(columns, 1);
  share_slope_ = cover->share_slope.replicate(columns, 1);
}

// Poiseuille part: the sum over axial faces of (l_a + l_b)/4 (p_b - p_a) L, written per cell as w p
// with w = L/4 (l_before - l_after); at a pad's end the cell's own thickness replaces that of the
// missing neighbour. Outside the liner, where 1/h may not be finite, there is none.
void Friction::add_film(const Reynolds& solution, const FilmPressure& pressure,
                        const ShearThickness& shear, double viscosity, double speed) {
  const PadGrid& grid = solution.grid();
  const Eigen::ArrayXd &p = pressure.value, &l = shear.lever;
  const int n_j = grid.n_axial();
  for (int i = 0; i < grid.n_angle(); ++i) {
    const double quarter = 0.25 * grid.arc(i);
    for (int j = 0; j < n_j; ++j) {
      const int c = grid.cell(i, j), before = grid.cell(i, std::max(j - 1, 0)),
                after = grid.cell(i, std::min(j + 1, n_j - 1));
      const double thickening = pressure.thickening != nullptr ? (*pressure.thickening)[c] : 1.0;
      const double drag = -viscosity * speed * grid.area()[c] * thickening;
      const double drag_slope = -viscosity * grid.area()[c] * thickening;
      const double lever = quarter * (l[before] - l[after]);
      const double share = share_[c], own = share * p[c];
      const double pressure_jump = (after == c ? -own : share_[after] * p[after]) -
                                   (before == c ? -own : share_[before] * p[before]);
      gap_slope_[c] += quarter * pressure_jump * shear.lever_slope[c];
      if (share == 0.0) continue;
      const ValueSlope sheared = solution.sheared(c);
      const double force = drag * sheared.value * shear.inverse[c] + lever * p[c];
      force_[c] += share * force;
      height_slope_[c] += share_slope_[c] * force;
      speed_slope_[c] += share * drag_slope * sheared.value * shear.inverse[c];
      gap_slope_[c] += share * drag * sheared.value * shear.inverse_slope[c];
      film_slope_[c] +=
          share * (solution.is_full(c) ? lever : drag * sheared.slope * shear.inverse[c]);
      if (pressure.thickening != nullptr && solution.is_full(c))
        film_slope_[c] += share * pressure.coefficient * drag * sheared.value * shear.inverse[c];
    }
  }
}

void Friction::add_contact(const PadGrid& grid, const Eigen::ArrayXd& contact,
                           const Eigen::ArrayXd& contact_slope, const Eigen::ArrayXd& rate_slope,
                           double speed) {
  const double smooth = std::hypot(speed, options_.reversal_speed), direction = speed / smooth;
  const double turning = options_.reversal_speed * options_.reversal_speed / std::pow(smooth, 3);
  const Eigen::ArrayXd traction = -options_.coefficient * direction * grid.area() * contact;
  force_ += share_ * traction;
  height_slope_ += share_slope_ * traction;
  speed_slope_ -= options_.coefficient * turning * share_ * grid.area() * contact;
  gap_slope_ -= options_.coefficient * direction * share_ * grid.area() * contact_slope;
  if (rate_slope.size() > 0)
    rate_slope_ = -options_.coefficient * direction * share_ * grid.area() * rate_slope;
}

}  // namespace clatter::film
