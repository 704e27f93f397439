// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Smooth curves that leave the rows of their table.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace clatter::dynamics {

/// Where a curve leaves the straight lines between the rows of its table most.
struct Overshoot {
  size_t row = 0;     // between it and the one after it
  double size = 0.0;  // in units of the values
  double step = 0.0;  // largest difference of neighbouring rows

  /// Beside a flank that is steep for its neighbours a spline swings by many times the flank's
  /// height (hard case S4). Through points of a smooth function, and through a flank of equal
  /// intervals, it leaves its chords by less than a third of the largest step.
  bool is_wild() const { return size > step * (1.0 + 1e-9); }
};

/// @param curve value at an abscissa. @param x ascending abscissae, with the one that closes a
/// period. @param y values of the rows, as many.
template <typename Curve>
Overshoot find_overshoot(const Curve& curve, const std::vector<double>& x,
                         const std::vector<double>& y) {
  constexpr int kParts = 16;
  Overshoot worst;
  double largest = 0.0;
  for (size_t i = 0; i + 1 < x.size(); ++i) {
    worst.step = std::max(worst.step, std::abs(y[i + 1] - y[i]));
    largest = std::max(largest, std::abs(y[i]));
    for (int k = 1; k < kParts; ++k) {
      const double share = static_cast<double>(k) / kParts;
      const double off =
          std::abs(curve(x[i] + share * (x[i + 1] - x[i])) - (y[i] + share * (y[i + 1] - y[i])));
      if (off > worst.size) worst.row = i, worst.size = off;
    }
  }
  // Of a constant table only rounding is left.
  if (worst.size < 1e-9 * largest) worst.size = 0.0;
  return worst;
}

}  // namespace clatter::dynamics
