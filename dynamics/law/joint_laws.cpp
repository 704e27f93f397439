// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/law/joint_laws.hpp"

#include <cmath>

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// M_f and its slope by the load.
std::pair<double, double> friction_at(const PinFriction& law, double load) {
  if (const double* arm = std::get_if<double>(&law.moment)) return {*arm * load, *arm};
  const auto& table = std::get<RisingTable>(law.moment);
  return {table.value(load), table.slope(load)};
}

}  // namespace

PairForce RadialJoint::force(const Stage&, const PairMotion& motion, bool with_derivatives) {
  const Vector3d& d = motion.distance;
  const double e = d.norm();
  const RadialPoint at = radial_point(law_, e);
  const double across = e > 0.0 ? at.force / e : at.slope;  // F / e
  PairForce law;
  law.force = -across * d - at.damping * motion.velocity;
  law.stored = radial_energy(law_, e);
  law.lost = at.damping * motion.velocity.squaredNorm();
  if (!with_derivatives) return law;
  law.by_rate.diagonal().head<3>().setConstant(-at.damping);
  auto by_distance = law.by_distance.topLeftCorner<3, 3>();
  by_distance.diagonal().setConstant(-across);
  if (e > 0.0) {
    const Vector3d n = d / e;
    by_distance -= ((at.slope - across) * n + at.damping_slope * motion.velocity) * n.transpose();
  }
  return law;
}

std::unique_ptr<PairLaw> linear_joint(double stiffness, double damping) {
  return std::make_unique<RadialJoint>(RadialLaw{0.0, stiffness, 0.0, 1.0, damping});
}

PairForce LineSpring::force(const Stage&, const PairMotion& motion, bool with_derivatives) {
  const double length = motion.distance.norm();
  const Vector3d n = motion.distance / length;
  const double speed = n.dot(motion.velocity);
  const double pull = stiffness_ * (length - length_) + damping_ * speed;
  PairForce law;
  law.force = -pull * n;
  law.stored = 0.5 * stiffness_ * (length - length_) * (length - length_);
  law.lost = damping_ * speed * speed;
  if (!with_derivatives) return law;
  const Matrix3d along = n * n.transpose(), across = (Matrix3d::Identity() - along) / length;
  law.by_distance.topLeftCorner<3, 3>() =
      -stiffness_ * along - pull * across - damping_ * n * (across * motion.velocity).transpose();
  law.by_rate.topLeftCorner<3, 3>() = -damping_ * along;
  return law;
}

PairForce FrictionJoint::force(const Stage& stage, const PairMotion& motion,
                               bool with_derivatives) {
  PairForce law = joint_->force(stage, motion, with_derivatives);
  const double load = law.force.norm(), w = motion.spin(axis_);
  const auto [size, by_load] = friction_at(friction_, load);
  const double root = std::hypot(w, friction_.reversal_speed), sign = w / root;
  law.moment(axis_) = -size * sign;
  law.lost += size * sign * w;
  if (!with_derivatives) return law;
  const int row = 3 + axis_;
  if (load > 0.0) {
    const Eigen::RowVector3d along = -by_load * sign / load * law.force.transpose();
    law.by_distance.row(row) = along * law.by_distance.topRows<3>();
    law.by_rate.row(row) = along * law.by_rate.topRows<3>();
  }
  const double w_0 = friction_.reversal_speed / root;
  law.by_rate(row, row) -= size * w_0 * w_0 / root;
  return law;
}

}  // namespace clatter::dynamics
