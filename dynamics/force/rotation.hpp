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
inline Matrix43 quaternion_rates(const Eigen::Vector4d& q) {
  Matrix43 Q;
  Q.row(0) = -q.tail<3>().transpose();
  Q.bottomRows<3>() = q(0) * Eigen::Matrix3d::Identity() + skew(q.tail<3>());
  return Q;
}

/// R(w) with q * (0, w) = R q.
inline Eigen::Matrix4d spin_matrix(const Eigen::Vector3d& w) {
  Eigen::Matrix4d R;
  R << 0.0, -w.transpose(), w, -skew(w);
  return R;
}

/// The rotation matrix of q / |q|.
inline Eigen::Matrix3d rotation_matrix(const Eigen::Vector4d& q) {
  const Eigen::Vector3d u = q.tail<3>();
  const double w = q(0);
  const Eigen::Matrix3d scaled = (w * w - u.squaredNorm()) * Eigen::Matrix3d::Identity() +
                                 2.0 * u * u.transpose() + 2.0 * w * skew(u);
  return scaled / q.squaredNorm();
}

/// dt/dq of the small rotation t in the engine's axes by which A(q + dq) = (I + skew(t)) A(q):
/// t = 2 (dq * conj(q)) / |q|^2, whose vector part this is; 3 x 4.
inline Matrix34 turn_by_quaternion(const Eigen::Vector4d& q) {
  const Eigen::Vector3d u = q.tail<3>();
  Matrix34 turn;
  turn.col(0) = -u;
  turn.rightCols<3>() = q(0) * Eigen::Matrix3d::Identity() + skew(u);
  return turn * (2.0 / q.squaredNorm());
}

/// d(A c)/dq = t x A c for a vector c of the body, 3 x 4.
inline Matrix34 rotated_by_quaternion(const Eigen::Vector4d& q, const Eigen::Vector3d& c) {
  return -skew(rotation_matrix(q) * c) * turn_by_quaternion(q);
}

}  // namespace clatter::dynamics
