// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rigid bodies with large motion, in absolute coordinates.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "dynamics/body/modal_body.hpp"

namespace clatter::dynamics {

/// Where a rigid body moves in a plane: centre of mass (u, v) [m] and rotation [rad].
struct PlanarMotion {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double angle = 0.0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  double spin = 0.0;                                   // [rad/s]
};

/// A body in a plane with the coordinates u, v, angle. Its mass matrix is diagonal and constant for
/// any rotation (paper, eq. (3)).
/// @param mass [kg]. @param inertia about the centre of mass [kg m2]. InputError unless both are
/// positive.
ModalBody make_planar_body(const std::string& name, double mass, double inertia,
                           const PlanarMotion& start);

/// Where a rigid body moves in space.
struct SpatialMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();              // of mass [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // from the body's axes
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            // [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  // angular velocity, in the body's axes [rad/s]
};

/// Coordinates of a spatial body, in this order: centre of mass (3, of second order), quaternion
/// (w, x, y, z) and angular velocity in the body's principal axes (3), both states.
inline constexpr int kCentre = 0, kQuaternion = 3, kSpin = 7, kSpatial = 10;

/// A body in space, eq. (1) and (2) of the paper: m r'' = f, J w' = m - w x J w in its principal
/// axes. Its system needs a SpinElement, which relates the quaternion to the angular velocity.
/// @param mass [kg]. @param inertia principal moments about the centre of mass [kg m2]. InputError
/// unless they are positive and no moment exceeds the sum of the other two.
ModalBody make_spatial_body(const std::string& name, double mass, const Eigen::Vector3d& inertia,
                            const SpatialMotion& start);

}  // namespace clatter::dynamics
