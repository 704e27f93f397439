// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A body that moves freely in space, in a system.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/body/spatial_port.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// A spatial body of a system: its coordinates, and its motion at the end of a step.
struct SpatialBody {
  int body = 0;                  // in the system
  std::vector<int> coordinates;  // y indices, 10 + n
  std::shared_ptr<const SpatialFrame> frame;

  /// A point at `arm` from the centre of mass, in the body's axes [m], with its displacement and
  /// rotation by the modes, 3 x n; empty for a rigid body.
  std::unique_ptr<Port> port(const Eigen::Vector3d& arm, const Matrix3X& shape = {},
                             const Matrix3X& slope = {}) const;
  /// Attitude (quaternion w, x, y, z, from the body's axes) and angular velocity in the body's axes
  /// [rad/s] at a state of the integrator.
  Eigen::Vector4d quaternion(const StageState& state) const;
  Eigen::Vector3d spin(const StageState& state) const;
};

/// y indices of the 10 + n coordinates of a spatial body.
std::vector<int> coordinates_in_space(System& system, int body);
/// Adds a spatial body, rigid or floating, with its coordinates and its SpinElement.
SpatialBody add_spatial_body(System& system, ModalBody body);
/// Adds coordinates and SpinElement of a body that the system has.
SpatialBody add_rotation(System& system, int body);

}  // namespace clatter::dynamics
