// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The axes of a shaft: its own, and two across it.
#include <Eigen/Core>

namespace clatter::dynamics {

/// A shaft along one of the scene's axes: first, second and the shaft's axis are right-handed.
struct ShaftAxes {
  int axis = 2;  // 0, 1 or 2: x, y or z
  int first() const { return (axis + 1) % 3; }
  int second() const { return (axis + 2) % 3; }
  Eigen::Vector3d unit() const { return Eigen::Vector3d::Unit(axis); }
};

}  // namespace clatter::dynamics
