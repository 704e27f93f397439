// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rotations by quaternions q = (w, x, y, z), from the axes of a body to those of the engine.
#include <Eigen/Core>

namespace clatter::dynamics {

using Matrix43 = Eigen::Matrix<double, 4, 3>;
using Matrix34 = Eigen::Matrix<double, 3, 4>;
using Matrix3X = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// a x b = skew(a) b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

/// Q(q) with q * (0, w) = Q w, so that q' = Q w / 2 for an angular velocity w in the body's axes.
Matrix43 quaternion_rates(const Eigen::Vector4d& q);

/// R(w) with q * (0, w) = R q.
Eigen::Matrix4d spin_matrix(const Eigen::Vector3d& w);

/// The rotation matrix of q / |q|.
Eigen::Matrix3d rotation_matrix(const Eigen::Vector4d& q);

/// dt/dq of the small rotation t in the engine's axes by which A(q + dq) = (I + skew(t)) A(q):
/// t = 2 (dq * conj(q)) / |q|^2, whose vector part this is; 3 x 4.
Matrix34 turn_by_quaternion(const Eigen::Vector4d& q);

/// d(A c)/dq = t x A c for a vector c of the body, 3 x 4.
Matrix34 rotated_by_quaternion(const Eigen::Vector4d& q, const Eigen::Vector3d& c);

}  // namespace clatter::dynamics
