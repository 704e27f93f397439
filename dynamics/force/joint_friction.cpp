// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/joint_friction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter::dynamics {
namespace {

/// M_f and its slope by the load.
std::pair<double, double> friction_at(const PinFriction& law, double load) {
  if (const double* arm = std::get_if<double>(&law.moment)) return {*arm * load, *arm};
  const auto& table = std::get<RisingTable>(law.moment);
  return {table.value(load), table.slope(load)};
}

}  // namespace

int place_of(const JointSide& side, std::vector<int>& coordinates) {
  if (!side.coordinate) return -1;
  const auto found = std::find(coordinates.begin(), coordinates.end(), *side.coordinate);
  const auto place = static_cast<int>(found - coordinates.begin());
  if (found == coordinates.end()) coordinates.push_back(*side.coordinate);
  return place;
}

FrictionJoint::FrictionJoint(std::string name, std::unique_ptr<Anchor> a, std::unique_ptr<Anchor> b,
                             const RadialForce& law, PinFriction friction, JointSide side_a,
                             JointSide side_b)
    : Joint(std::move(name), std::move(a), std::move(b), law),
      friction_(std::move(friction)),
      side_a_(std::move(side_a)),
      side_b_(std::move(side_b)),
      planar_(std::ssize(coordinates_)) {
  const int at_a = place_of(side_a_, coordinates_), at_b = place_of(side_b_, coordinates_);
  turn_.setZero(std::ssize(coordinates_));
  if (at_a >= 0) turn_(at_a) += 1.0;
  if (at_b >= 0) turn_(at_b) -= 1.0;
}

void FrictionJoint::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                             bool with_tangent, Response& response) {
  planar_y_ = y.head(planar_);
  planar_v_ = v.head(planar_);
  Joint::evaluate(stage, planar_y_, planar_v_, with_tangent, plain_);
  const Eigen::Index n = turn_.size();
  const double load = last().force.norm();
  const auto [size, by_load] = friction_at(friction_, load);
  const double prescribed = turning_at(side_a_, stage.time) - turning_at(side_b_, stage.time);
  const double w = turn_.dot(v) + prescribed;
  const double root = std::hypot(w, friction_.reversal_speed), sign = w / root;
  last_turning_ = {-size * sign, w, prescribed};
  response.force.setZero(n);
  response.force.head(planar_) = plain_.force;
  response.force += last_turning_.moment * turn_;
  if (!with_tangent) return;
  response.tangent.setZero(n, n);
  response.tangent.topLeftCorner(planar_, planar_) = plain_.tangent;
  const double w_0 = friction_.reversal_speed / root;
  response.tangent.noalias() -= (size * w_0 * w_0 / root / stage.kappa * turn_) * turn_.transpose();
  if (load == 0.0) return;
  load_by_y_.noalias() = force_by_y().transpose() * (last().force / load);
  response.tangent.leftCols(planar_).noalias() -= (by_load * sign * turn_) * load_by_y_.transpose();
}

void FrictionJoint::finish_stage(const Stage& stage) {
  Joint::finish_stage(stage);
  finished_turning_ = last_turning_;
}

void FrictionJoint::accept_step(double time) {
  Joint::accept_step(time);
  accepted_turning_ = finished_turning_;
}

Power FrictionJoint::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  planar_y_ = y.head(planar_);
  planar_v_ = v.head(planar_);
  Power power = Joint::power(planar_y_, planar_v_);
  power.lost += finished_turning_.lost();
  power.input -= finished_turning_.moment * finished_turning_.prescribed;
  return power;
}

void FrictionJoint::record(History& history) const {
  Joint::record(history);
  history.put(name() + "_friction_moment", "N m", accepted_turning_.moment);
  history.put(name() + "_friction_power", "W", accepted_turning_.lost());
}

}  // namespace clatter::dynamics
