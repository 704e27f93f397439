// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cubic splines in the plane with continuous curvature.
#include <Eigen/Core>
#include <vector>

#include "dynamics/profile/segment.hpp"

namespace clatter::dynamics {

/// One cubic of a curve: c0 + w (c1 + w (c2 + w c3)), w = parameter - begin, up to `end`.
struct Cubic {
  double begin, end;
  Eigen::Vector2d c0, c1, c2, c3;  // [m] for w in [m] or without unit

  Eigen::Vector2d position(double at) const {
    const double w = at - begin;
    return c0 + w * (c1 + w * (c2 + w * c3));
  }
  Eigen::Vector2d derivative(double at) const {
    const double w = at - begin;
    return c1 + w * (2.0 * c2 + 3.0 * w * c3);
  }
  Eigen::Vector2d second_derivative(double at) const { return 2.0 * c2 + 6.0 * (at - begin) * c3; }
};

/// The cubics of the spline through the points; the parameter is the length of the chords [m].
/// InputError for too few points, points closer than 1e-9 m, and values that are not finite.
std::vector<Cubic> points_spline(const PointsSegment& segment);

/// The cubic of a Bezier curve over the parameter 0 to 1.
Cubic bezier_cubic(const BezierSegment& segment);

}  // namespace clatter::dynamics
