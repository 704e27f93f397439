// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A law as a table that rises from 0: force over displacement, moment over load.
#include <vector>

#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// y(x) for x >= 0 through given points from (0, 0): the monotone cubic of Spline, C1, and beyond
/// the last point its tangent there.
class RisingTable {
 public:
  /// @param x n >= 2, ascending from 0. @param y n, from 0, nowhere descending. InputError
  /// otherwise.
  RisingTable(std::vector<double> x, std::vector<double> y);

  double value(double x) const;
  double slope(double x) const;     // dy/dx
  double integral(double x) const;  // of y from 0, exact
  double last() const { return x_.back(); }

 private:
  double part(size_t k, double x) const;
  std::vector<double> x_;
  Spline inside_;
  std::vector<double> integral_;  // at the points
  double last_, last_slope_;
};

}  // namespace clatter::dynamics
