// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {

Friction::Friction(const FrictionOptions& options, int cells)
    : options_(options), force_(cells), gap_slope_(cells), film_slope_(cells) {
  if (!(options.coefficient >= 0.0) || !(options.reversal_speed > 0.0))
    throw InputError(
        fmt::format("friction: found coefficient {}, reversal speed {} m/s, expected >= 0 and > 0",
                    options.coefficient, options.reversal_speed));
  clear();
}

void Friction::clear() {
  force_.setZero();
  gap_slope_.setZero();
  film_slope_.setZero();
}

// Poiseuille part: the sum over axial faces of (s_a + s_b)/4 (p_b - p_a) L, written per cell as w p
// with w = L/4 (s_before - s_after); at a pad's end the cell's own thickness replaces that of the
// missing neighbour.
void Friction::add_film(const Reynolds& solution, const FilmCells& film,
                        const Eigen::ArrayXd& inverse, const Eigen::ArrayXd& inverse_slope,
                        double viscosity, double speed) {
  const PadGrid& grid = solution.grid();
  const Eigen::ArrayXd &p = solution.pressure(), &fill = solution.fill(), &s = film.content;
  const int n_j = grid.n_axial();
  for (int i = 0; i < grid.n_angle(); ++i) {
    const double quarter = 0.25 * grid.arc(i);
    for (int j = 0; j < n_j; ++j) {
      const int c = grid.cell(i, j), before = grid.cell(i, std::max(j - 1, 0)),
                after = grid.cell(i, std::min(j + 1, n_j - 1));
      const double drag = -viscosity * speed * grid.area()[c];
      const double lever = quarter * (s[before] - s[after]);
      const double pressure_jump =
          (after == c ? -p[c] : p[after]) - (before == c ? -p[c] : p[before]);
      force_[c] += drag * fill[c] * inverse[c] + lever * p[c];
      gap_slope_[c] +=
          drag * fill[c] * inverse_slope[c] + quarter * pressure_jump * film.d_content[c];
      film_slope_[c] += solution.is_full(c) ? lever : drag * inverse[c];
    }
  }
}

void Friction::add_contact(const PadGrid& grid, const Eigen::ArrayXd& contact,
                           const Eigen::ArrayXd& contact_slope, const Eigen::ArrayXd& rate_slope,
                           double speed) {
  const double direction = speed / std::hypot(speed, options_.reversal_speed);
  force_ -= options_.coefficient * direction * grid.area() * contact;
  gap_slope_ -= options_.coefficient * direction * grid.area() * contact_slope;
  if (rate_slope.size() > 0)
    rate_slope_ = -options_.coefficient * direction * grid.area() * rate_slope;
}

}  // namespace clatter::film
