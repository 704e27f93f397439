// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Coordinate systems for directions: [system.NAME] of a part's fe.toml.
#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/keys/keys.hpp"

namespace clatter::fe {

/// Names of DoFs: displacements along x, y, z and rotations about them.
inline constexpr std::array<const char*, 6> kDofNames = {"x", "y", "z", "rx", "ry", "rz"};

/// Rectangular, cylindrical or spherical axes. In a rectangular system the directions are x, y, z;
/// in a cylindrical one radial, tangential, axial; in a spherical one radial, along the meridian
/// (away from +z), along the circle of latitude.
struct Axes {
  enum class Kind { kRectangular, kCylindrical, kSpherical };
  Kind kind = Kind::kRectangular;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();     // [m]
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  // columns: x, y, z

  /// The three directions at a position [m], as columns; right-handed and orthonormal. On the axis
  /// of revolution angle zero is used.
  Eigen::Matrix3d at(const Eigen::Vector3d& position) const;
};

/// The table [system.NAME], with the axes that follow from it.
struct AxesTable {
  keys::Source source{};
  Axes axes{};
  Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  std::optional<Eigen::Vector3d> x = std::nullopt;
};

/// Sets the frame from x and z; InputError when they are parallel.
void finish(AxesTable& table);

/// Its keys.
const keys::Keys<AxesTable>& axes_keys();

/// An axis of rotation.
struct RotationAxis {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       // [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  // unit vector
  /// Vector from the axis to `x`, perpendicular to the axis [m].
  Eigen::Vector3d arm(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d r = x - point;
    return r - r.dot(direction) * direction;
  }
};

}  // namespace clatter::fe
