// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The rotation of a rigid body on which no moment acts.
#include <Eigen/Core>

namespace clatter::dynamics {

/// Where a body's axes are at an instant.
struct Attitude {
  Eigen::Vector4d q;     // quaternion (w, x, y, z), from the body's axes to those of the engine
  Eigen::Matrix3d A;     // the same rotation as a matrix
  Eigen::Vector3d spin;  // angular velocity, in the engine's axes [rad/s]
};

/// The rotation of a rigid body that no moment acts on, from a given attitude and spin, at any
/// later or earlier time and to rounding: with the angular momentum L constant in space and m = A^T
/// L,
///
///   m' = m x w,   q' = q * (0, w) / 2,   w = J^-1 m
///
/// are quadratic, so that their Taylor coefficients follow from each other; orders and step lengths
/// as in Jorba and Zou (2005). It is the part of a body's rotation that is known exactly; the
/// integrator has to find only the deviation from it (Celledoni et al. 2008).
class FreeRotation {
 public:
  /// @param inertia about the centre of mass, in the body's axes, symmetric positive definite
  /// [kg m2]. @param rotation quaternion of unit length. @param spin in the engine's axes [rad/s].
  FreeRotation(const Eigen::Matrix3d& inertia, double time, const Eigen::Vector4d& rotation,
               const Eigen::Vector3d& spin);

  /// The rotation goes on from here.
  void restart(double time, const Eigen::Vector4d& rotation, const Eigen::Vector3d& spin);
  const Attitude& at(double time) const;
  /// Its angular momentum, in the engine's axes [N m s].
  const Eigen::Vector3d& momentum() const { return momentum_; }
  /// The time of the last restart [s], and where the body was then.
  double start() const { return start_; }
  const Attitude& first() const { return first_; }

 private:
  Eigen::Matrix3d inertia_, inverse_;
  double start_ = 0.0;
  Attitude first_;
  Eigen::Vector3d momentum_;  // L
  // Mutable: the last result, as many ask for the same instant.
  mutable double time_ = 0.0;
  mutable Attitude last_;  // at time_
};

}  // namespace clatter::dynamics
