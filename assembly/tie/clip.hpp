// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Intersection of convex polygons in a plane.
#include <Eigen/Core>
#include <vector>

namespace clatter::assembly {

/// Corners in order.
using Polygon = std::vector<Eigen::Vector2d>;

/// Twice the signed area is positive for corners in counter-clockwise order.
double signed_area(const Polygon& polygon);

/// The part of `subject` inside the convex polygon `window`, both counter-clockwise (Sutherland and
/// Hodgman 1974). Empty when they do not overlap.
Polygon clip(const Polygon& subject, const Polygon& window);

}  // namespace clatter::assembly
