// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Vectors in a plane.
#include <Eigen/Core>

namespace clatter::dynamics {

/// a turned by 90 degrees to the left.
inline Eigen::Vector2d across(const Eigen::Vector2d& a) { return {-a.y(), a.x()}; }
/// The component of a x b across the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace clatter::dynamics
