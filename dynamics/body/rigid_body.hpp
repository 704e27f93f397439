// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rigid bodies with large motion, in absolute coordinates.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "dynamics/body/modal_body.hpp"
#include "dynamics/body/spatial_frame.hpp"

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

/// A body with one coordinate, its displacement along an axis fixed in space. What guides it is not
/// part of it: see SlidePort.
/// @param mass [kg]; InputError unless positive. @param axis unit vector. @param velocity at the
/// start along the axis [m/s].
ModalBody make_sliding_body(const std::string& name, double mass, const Eigen::Vector3d& axis,
                            double velocity);

/// Where a rigid body moves in space.
struct SpatialMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();              // of mass [m]
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // from the body's axes
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            // [m/s]
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  // angular velocity, in the body's axes [rad/s]
};

/// A body in space, eq. (1) and (2) of the paper: m r'' = f, J w' = m - w x J w in its principal
/// axes, with the coordinates of spatial_frame.hpp. Its system needs a SpinElement.
/// @param mass [kg]. @param inertia principal moments about the centre of mass [kg m2]. InputError
/// unless they are positive and no moment exceeds the sum of the other two.
ModalBody make_spatial_body(const std::string& name, double mass, const Eigen::Vector3d& inertia,
                            const SpatialMotion& start);

/// The part of every spatial body that is the same without and with modes: its ten first
/// coordinates and its frame. @param least the smallest principal moment of inertia [kg m2].
ModalBody spatial_coordinates(const std::string& name, double mass, double least,
                              std::shared_ptr<SpatialFrame> frame, const SpatialMotion& start);

/// A rotation as (w, x, y, z) of unit length.
Eigen::Vector4d quaternion_of(const Eigen::Quaterniond& rotation);

}  // namespace clatter::dynamics
