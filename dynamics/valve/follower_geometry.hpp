// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Kinematics of a roller finger follower.
#include <Eigen/Core>

#include "dynamics/given/cam_law.hpp"

namespace clatter::dynamics {

/// A follower that tilts about the ball of its adjuster, in the axes of its plane: origin at the
/// ball, y along the valve towards its spring (the valve opens along -y). Points at tilt 0, where
/// the valve is closed [m].
struct FollowerGeometry {
  Eigen::Vector2d roller = {17e-3, 9e-3};
  double roller_radius = 8.5e-3;
  Eigen::Vector2d pad = {34e-3, 8e-3};  // centre of the pad on the flat tip of the valve
  double pad_radius = 10e-3;
  Eigen::Vector2d cam = {15.36072e-3, 32.44276e-3};  // centre of the cam

  /// Of the cam: the roller touches it at tilt 0.
  double base_radius() const { return (roller - cam).norm() - roller_radius; }
  /// The highest lift to which the pad can turn [m].
  double highest_lift() const { return pad.norm() + pad.y(); }
};

/// A follower whose cam opens the valve by a lift law, at one angle of the cam.
struct FollowerState {
  double tilt = 0.0;            // clockwise, towards the open valve [rad]
  double tilt_by_angle = 0.0;   // d tilt / d(cam angle)
  Eigen::Vector2d roller, pad;  // centres [m]
  Eigen::Vector2d normal;       // from cam to roller, unit vector
  /// Of the roller's centre in the cam's axes: the pitch curve [m] and its curvature, positive
  /// where it is convex [1/m].
  Eigen::Vector2d pitch;
  double curvature = 0.0;
  double roller_force = 0.0;   // over the force of the valve on the pad, without inertia
  Eigen::Vector2d ball_force;  // on the ball, over the same
};

/// The follower at a lift of the valve and its first two derivatives by the angle of the cam, which
/// turns counter-clockwise in the plane's axes if `turn` is 1, else -1 clockwise. At `angle` 0 the
/// cam's axes are those of the plane. Lift s: with the pad's centre (p_x, p_y)
///   s = p_x sin(tilt) + p_y (1 - cos(tilt))
/// The pad rolls and slides on the tip; contacts have no friction.
FollowerState follower_at(const FollowerGeometry& geometry, const SplinePoint& lift, double angle,
                          double turn);

}  // namespace clatter::dynamics
