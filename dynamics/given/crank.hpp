// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Kinematics of the ideal slider-crank with rigid parts and no clearances.
#include <Eigen/Core>

#include "dynamics/given/crank_clock.hpp"
#include "dynamics/given/motion.hpp"

namespace clatter::dynamics {

/// Direction in which a crankshaft turns: `kForward` is the positive rotation about x, in which the
/// gas force pushes the piston toward +y after firing top dead centre; `kBackward` mirrors y.
enum class Rotation { kForward, kBackward };

/// Crank of radius r at (0, 0), rod of length l, piston pin on the line y = e.
///
/// theta = crank angle - firing with 0 at firing top dead centre of the crank. The crank pin is at
/// (y, z) = (-s r sin theta, r cos theta), s = 1 forward and -1 backward: the gas force pushes the
/// piston toward s y, the thrust side, after top dead centre. The rod's angle phi about x obeys sin
/// phi = (y_c - e)/l and the pin is at z_B = z_c + l cos phi (Heywood 1988, section 2.2, for e =
/// 0).
class SliderCrank {
 public:
  /// Lengths [m]. `firing`: where the crankshaft's angle is at this cylinder's firing top dead
  /// centre [rad]. InputError unless r > 0, l > r + |e|.
  SliderCrank(double radius, double rod_length, double pin_offset, CrankClock clock,
              double firing = 0.0, Rotation rotation = Rotation::kForward);

  double radius() const { return radius_; }
  double rod_length() const { return rod_length_; }
  double pin_offset() const { return pin_offset_; }
  const CrankClock& clock() const { return clock_; }
  double firing() const { return firing_; }
  Rotation rotation() const { return sign_ > 0.0 ? Rotation::kForward : Rotation::kBackward; }
  /// Angular velocity of the crankshaft about +x [rad/s].
  double spin(double time) const { return sign_ * clock_.turn(time).velocity; }
  /// theta by the clock [rad], [rad/s], [rad/s2].
  Motion<double> turn(double time) const;
  double angle(double time) const { return clock_.angle(time) - firing_; }  // theta [rad]
  double time(double angle) const { return clock_.time(angle + firing_); }

  Motion<Eigen::Vector2d> crank_pin(double time) const;  // (y, z) [m]
  Motion<double> rod_angle(double time) const;           // phi [rad]
  Motion<double> piston_pin(double time) const;          // z_B [m]
  /// Point of the rod at `distance` from the crank pin, (y, z) [m].
  Motion<Eigen::Vector2d> rod_point(double time, double distance) const;

  // The same where theta is not that of the clock.
  Motion<Eigen::Vector2d> crank_pin(const Motion<double>& theta) const;
  Motion<double> rod_angle(const Motion<double>& theta) const;
  Motion<double> piston_pin(const Motion<double>& theta) const;
  Motion<Eigen::Vector2d> rod_point(const Motion<double>& theta, double distance) const;

 private:
  double radius_, rod_length_, pin_offset_, firing_, sign_;
  CrankClock clock_;
};

/// Direction of the rod from crank pin to piston pin, (y, z) = (-sin phi, cos phi).
Eigen::Vector2d rod_direction(double phi);

}  // namespace clatter::dynamics
