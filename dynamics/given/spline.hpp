// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Interpolation of a table, smooth and without overshoot.
#include <vector>

namespace clatter::dynamics {

/// y(x) through given points: linear, or monotone piecewise cubic (C1, no new extrema).
///
/// The slopes are those of Fritsch and Butland (1984): the weighted harmonic mean of the secants at
/// both sides, zero at a turning point. Periodic: y(x + period) = y(x), the last interval closes to
/// the first point.
class Spline {
 public:
  enum class Kind { kLinear, kMonotoneCubic };
  /// `x` strictly ascending, at least one point; period 0: not periodic, constant beyond both ends.
  Spline(Kind kind, std::vector<double> x, std::vector<double> y, double period = 0.0);

  double operator()(double at) const;
  /// dy/dx; at a point of a linear one that of the interval after it (at the end, before it), 0
  /// beyond the ends.
  double slope(double at) const;
  /// The first of the given points above `at`; infinity above the last one of a table that is not
  /// periodic.
  double next_point(double at) const;

 private:
  Kind kind_;
  std::vector<double> x_, y_, slope_;
  double period_;
};

/// The slopes of the monotone cubic at all points, those of the secants at both ends; not periodic,
/// at least two points.
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace clatter::dynamics
