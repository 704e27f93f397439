// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

Matrix43 quaternion_rates(const Vector4d& q) {
  Matrix43 Q;
  Q.row(0) = -q.tail<3>().transpose();
  Q.bottomRows<3>() = q(0) * Matrix3d::Identity() + skew(q.tail<3>());
  return Q;
}

Matrix4d spin_matrix(const Vector3d& w) {
  Matrix4d R;
  R << 0.0, -w.transpose(), w, -skew(w);
  return R;
}

Matrix3d rotation_matrix(const Vector4d& q) {
  const Vector3d u = q.tail<3>();
  const double w = q(0);
  const Matrix3d scaled = (w * w - u.squaredNorm()) * Matrix3d::Identity() +
                          2.0 * u * u.transpose() + 2.0 * w * skew(u);
  return scaled / q.squaredNorm();
}

Matrix34 turn_by_quaternion(const Vector4d& q) {
  const Vector3d u = q.tail<3>();
  Matrix34 turn;
  turn.col(0) = -u;
  turn.rightCols<3>() = q(0) * Matrix3d::Identity() + skew(u);
  return turn * (2.0 / q.squaredNorm());
}

Matrix34 rotated_by_quaternion(const Vector4d& q, const Vector3d& c) {
  return -skew(rotation_matrix(q) * c) * turn_by_quaternion(q);
}

}  // namespace clatter::dynamics
