// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/port_element.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "dynamics/force/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

std::vector<int> joined(const Port& a, const Port& b) {
  std::vector<int> all = a.coordinates();
  all.insert(all.end(), b.coordinates().begin(), b.coordinates().end());
  return all;
}

}  // namespace

PortElement::PortElement(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b)
    : ForceElement(joined(*a, *b)), name_(std::move(name)), a_(std::move(a)), b_(std::move(b)) {
  std::string prefix = name_ + "_force_";
  std::replace(prefix.begin(), prefix.end(), ' ', '_');
  for (size_t k = 0; k < 3; ++k) recorded_[k] = prefix + "xyz"[k];
}

PairMotion PortElement::move(double time, const VectorXd& y, const VectorXd& v) const {
  y_a_ = y.head(a_->size());
  v_a_ = v.head(a_->size());
  y_b_ = y.tail(b_->size());
  v_b_ = v.tail(b_->size());
  a_->motion(time, y_a_, v_a_, at_a_);
  b_->motion(time, y_b_, v_b_, at_b_);
  const Vector3d distance = at_a_.position - at_b_.position;
  return {distance, at_a_.velocity - at_b_.velocity - at_b_.spin.cross(distance),
          at_a_.spin - at_b_.spin};
}

void PortElement::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                           bool with_tangent, Response& response) {
  const int n_a = a_->size(), n_b = b_->size();
  time_ = stage.time;
  const PairMotion pair = move(time_, y, v);
  const PairForce law = force(time_, pair);
  last_ = law.force;
  const Vector6 on_a = wrench(law.force, law.moment);
  const Vector6 on_b = wrench(-law.force, -law.moment - pair.distance.cross(law.force));
  response.force.resize(n_a + n_b);
  response.force.head(n_a).noalias() = at_a_.work.transpose() * on_a;
  response.force.tail(n_b).noalias() = at_b_.work.transpose() * on_b;
  if (!with_tangent) return;

  Matrix6X &distance = distance_by_y_, &rate = rate_by_y_;
  distance.resize(6, n_a + n_b);
  rate.resize(6, n_a + n_b);
  distance.leftCols(n_a) = at_a_.by_y;
  distance.rightCols(n_b) = -at_b_.by_y;
  rate.leftCols(n_a) = at_a_.rate_by_y + at_a_.rate_by_v / stage.kappa;
  rate.rightCols(n_b) = -at_b_.rate_by_y - at_b_.rate_by_v / stage.kappa;
  const Eigen::Matrix3d turning = skew(at_b_.spin), arm = skew(pair.distance);
  for (int j = 0; j < n_a + n_b; ++j) {
    Vector3d change = turning * distance.col(j).head<3>();
    if (j >= n_a) change += arm * rate.col(j).tail<3>();
    rate.col(j).head<3>() -= change;
  }
  by_a_.noalias() = law.by_distance * distance;
  by_a_.noalias() += law.by_rate * rate;
  by_b_ = -by_a_;
  const Eigen::Matrix3d pulled = skew(law.force);
  for (int j = 0; j < n_a + n_b; ++j)
    by_b_.col(j).tail<3>() += pulled * distance.col(j).head<3>() - arm * by_a_.col(j).head<3>();
  response.tangent.resize(n_a + n_b, n_a + n_b);
  response.tangent.topRows(n_a).noalias() = at_a_.work.transpose() * by_a_;
  response.tangent.bottomRows(n_b).noalias() = at_b_.work.transpose() * by_b_;
  a_->add_curvature(y_a_, on_a, response.tangent.topLeftCorner(n_a, n_a));
  b_->add_curvature(y_b_, on_b, response.tangent.bottomRightCorner(n_b, n_b));
}

Power PortElement::power(const VectorXd& y, const VectorXd& v) const {
  const PairMotion pair = move(time_, y, v);
  const PairForce law = force(time_, pair);
  double input = 0.0;
  if (a_->is_driven()) input -= wrench(law.force, law.moment).dot(a_->driven(at_a_));
  if (b_->is_driven())
    input += wrench(law.force, law.moment + pair.distance.cross(law.force)).dot(b_->driven(at_b_));
  return {law.stored, law.lost, input};
}

void PortElement::record(History& history) const {
  for (size_t k = 0; k < 3; ++k)
    history.put(recorded_[k], "N", accepted_(static_cast<Eigen::Index>(k)));
}

PairForce Bushing::force(double, const PairMotion& motion) const {
  PairForce law;
  law.force = -stiffness_ * motion.distance - damping_ * motion.velocity;
  law.moment.setZero();
  law.by_distance.setZero();
  law.by_rate.setZero();
  law.by_distance.diagonal().head<3>().setConstant(-stiffness_);
  law.by_rate.diagonal().head<3>().setConstant(-damping_);
  law.stored = 0.5 * stiffness_ * motion.distance.squaredNorm();
  law.lost = damping_ * motion.velocity.squaredNorm();
  return law;
}

PairForce LineSpring::force(double, const PairMotion& motion) const {
  const double length = motion.distance.norm();
  const Vector3d n = motion.distance / length;
  const double speed = n.dot(motion.velocity);
  const double pull = stiffness_ * (length - length_) + damping_ * speed;
  const Eigen::Matrix3d along = n * n.transpose();
  const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - along) / length;
  PairForce law;
  law.force = -pull * n;
  law.moment.setZero();
  law.by_distance.setZero();
  law.by_rate.setZero();
  law.by_distance.topLeftCorner<3, 3>() =
      -stiffness_ * along - pull * across - damping_ * n * (across * motion.velocity).transpose();
  law.by_rate.topLeftCorner<3, 3>() = -damping_ * along;
  law.stored = 0.5 * stiffness_ * (length - length_) * (length - length_);
  law.lost = damping_ * speed * speed;
  return law;
}

}  // namespace clatter::dynamics
