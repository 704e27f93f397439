// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Smooth interpolation of a periodic table, with derivatives.
#include <vector>

namespace clatter::dynamics {

/// A value and its first three derivatives.
struct SplinePoint {
  double value = 0.0, first = 0.0, second = 0.0, third = 0.0;
};

/// The periodic interpolating spline of degree 3 (C2) or 5 (C4) through given points: the smoothest
/// ones in the second or third derivative (de Boor 1978). It may overshoot, unlike Spline.
class PeriodicSpline {
 public:
  /// @param x strictly ascending, at least 4 points within less than one period, without a closing
  /// one. @param degree 3 or 5.
  PeriodicSpline(int degree, std::vector<double> x, const std::vector<double>& y, double period);
  SplinePoint at(double x) const;
  /// The first of the given points above `x`.
  double next_point(double x) const;

 private:
  struct Piece {
    double c[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  // y = sum c_k s^k, s from the piece's begin
  };
  std::vector<double> x_;  // begins of the pieces
  std::vector<Piece> pieces_;
  double period_;
};

}  // namespace clatter::dynamics
