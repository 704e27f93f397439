// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/stop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kLiftHeight = 1e-6;  // a held point that is higher flies [m]
/// Points that are no higher touch, so that those of one body that falls flat do so together [m].
constexpr double kTouchHeight = 1e-9;
/// The damper of a held point acts from this depth on; below, less in proportion [m].
constexpr double kDampedDepth = 1e-9;

}  // namespace

Stop::Stop(const std::string& name, PointOnPlane pair, const FrictionLaw& friction)
    : ForceElement(pair.coordinates()), pair_(std::move(pair)), friction_(friction), name_(name) {
  recorded_ = {history_name("gap"), history_name("force"), history_name("slip")};
  if (friction.at_rest == 0.0) return;
  if (friction.slip_speed)
    creep_.emplace(*friction.slip_speed, 1);
  else
    bristle_.emplace(friction.stiffness, friction.damping_time * friction.stiffness,
                     friction.kinetic, friction.at_rest);
}

std::string Stop::history_name(const char* what) const {
  std::string name = name_ + "_" + what;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

Vector2d Stop::slip(const PlaneMotion& at) const {
  return pair_.axes().rightCols<2>().transpose() * at.slip;
}

Bristle::Force Stop::friction(const Stage& stage, const Vector2d& slip, double normal) {
  if (friction_.at_rest == 0.0) return {Vector2d::Zero(), Matrix2d::Zero(), Vector2d::Zero()};
  if (bristle_) return bristle_->evaluate(stage, slip, normal);
  // mu / |slip|, and its derivative by |slip| over |slip|.
  const double v = *friction_.slip_speed, speed = slip.norm(), x = speed / v;
  const double top = friction_.at_rest, low = friction_.kinetic;
  double factor = top * (1.5 - 0.5 * x * x) / v, slope = -top / (v * v * v);
  if (x >= 1.0) {
    const double s = std::min(x - 1.0, 1.0);
    factor = (top + (low - top) * s * s * (3.0 - 2.0 * s)) / speed;
    slope = ((low - top) * 6.0 * s * (1.0 - s) / v - factor) / (speed * speed);
  }
  return {normal * factor * slip,
          normal * (factor * Matrix2d::Identity() + slope * slip * slip.transpose()),
          factor * slip};
}

void Stop::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v, bool with_tangent,
                    Response& response) {
  time_ = stage.time;
  const PlaneMotion& at = pair_.move(time_, y, v);
  const NormalForce law = normal(std::max(-at.gap, 0.0), -at.rate);
  slip_ = slip(at);
  last_ = {at.gap, law.force, slip_.norm()};
  const Bristle::Force against = friction(stage, slip_, law.force);
  against_ = against.value;
  const Eigen::Matrix<double, 3, 2> tangents = pair_.axes().rightCols<2>();
  const Vector3d in_plane = tangents * against_;
  const Vector3d force = law.force * at.normal - in_plane;
  pair_.apply(force, response.force);
  if (!with_tangent) return;
  pair_.differentiate(1.0 / stage.kappa);
  by_normal_ = -law.by_depth * pair_.by_gap() - law.by_rate * pair_.by_rate();
  by_slip_.noalias() = tangents.transpose() * pair_.by_velocity();
  const Eigen::Matrix<double, 2, 3> turned = tangents.transpose() * skew(at.velocity);
  by_slip_.noalias() += turned * pair_.by_turn();
  by_against_.noalias() = against.by_slip * by_slip_;
  by_against_.noalias() += against.by_normal * by_normal_;
  by_force_ = law.force * pair_.by_normal();
  by_force_.noalias() += at.normal * by_normal_;
  by_force_.noalias() -= tangents * by_against_;
  const Eigen::Matrix3d across = skew(in_plane);
  by_force_.noalias() += across * pair_.by_turn();
  pair_.add_up(force, by_force_, response.tangent);
}

void Stop::finish_stage(const Stage& stage) {
  finished_ = last_;
  if (bristle_) bristle_->finish_stage(stage);
}

void Stop::accept_step(double time) {
  accepted_ = finished_;
  if (bristle_) bristle_->accept_step();
  if (creep_) creep_->accept_step(0, time, accepted_[1] > 0.0, slip_);
}

Power Stop::power(const VectorXd& y, const VectorXd& v) const {
  const PlaneMotion& at = pair_.move(time_, y, v);
  const NormalForce law = normal(std::max(-at.gap, 0.0), -at.rate);
  const Vector2d slip = this->slip(at);
  return {law.stored + (bristle_ ? bristle_->stored() : 0.0),
          law.lost + (bristle_ ? bristle_->lost(slip) : against_.dot(slip)),
          pair_.input(law.force * at.normal - pair_.axes().rightCols<2>() * against_)};
}

std::vector<double> Stop::save() const {
  return bristle_ ? bristle_->save() : std::vector<double>{};
}

void Stop::restore(const std::vector<double>& state) {
  if (state.size() != (bristle_ ? 5U : 0U))
    throw InputError(name() + ": the saved state belongs to another scene");
  if (bristle_) bristle_->restore(state);
}

void Stop::record(History& history) const {
  history.put(recorded_[0], "m", accepted_[0]);
  history.put(recorded_[1], "N", accepted_[1]);
  if (friction_.at_rest > 0.0) history.put(recorded_[2], "m/s", accepted_[2]);
}

NormalForce CompliantStop::normal(double depth, double rate) const {
  NormalForce law;
  const double steep = k_ * std::pow(depth, n_ - 1.0), elastic = steep * depth;
  law.stored = elastic * depth / (n_ + 1.0);
  const double damped = 1.0 + chi_ * rate;
  if (depth > 0.0 && damped > 0.0) {
    law.force = elastic * damped;
    law.by_depth = n_ * steep * damped;
    law.by_rate = elastic * chi_;
  }
  law.lost = (law.force - elastic) * rate;
  return law;
}

RigidStop::RigidStop(const std::string& name, PointOnPlane pair, double restitution,
                     double rest_stiffness, const FrictionLaw& friction)
    : Stop(name, std::move(pair), friction),
      restitution_(restitution),
      stiffness_(rest_stiffness),
      impulse_name_(history_name("impulse")) {}

NormalForce RigidStop::normal(double depth, double rate) const {
  NormalForce law;
  if (!held_ || depth <= 0.0) return law;
  const double full = depth + kDampedDepth, share = depth / full;
  const double damping = 2.0 * std::sqrt(stiffness_ * mass_) * share;
  law.stored = 0.5 * stiffness_ * depth * depth;
  const double force = stiffness_ * depth + damping * rate;
  if (force > 0.0) {
    law.force = force;
    law.by_depth = stiffness_ + 2.0 * std::sqrt(stiffness_ * mass_) * rate * (1.0 - share) / full;
    law.by_rate = damping;
  }
  law.lost = (law.force - stiffness_ * depth) * rate;
  return law;
}

double RigidStop::event_function(int index, double time, const VectorXd& y,
                                 const VectorXd& v) const {
  if (held_ != (index == kLift)) return 1.0;
  const double gap = pair_.move(time, y, v).gap;
  return held_ ? kLiftHeight - gap : gap;
}

void RigidStop::at_event(int, double) { held_ = false; }

std::optional<Touch> RigidStop::touch(double time, const VectorXd& y, const VectorXd& v) const {
  const PlaneMotion& at = pair_.move(time, y, v);
  if (at.gap > kTouchHeight) return std::nullopt;
  const Eigen::Matrix3d axes = pair_.axes();
  Touch touch{{restitution_, friction_.kinetic, held_}, axes.transpose() * at.velocity, {}, {}, {}};
  touch.impulses.resize(y.size(), 3);
  VectorXd one;
  for (int k = 0; k < 3; ++k) {
    pair_.apply(axes.col(k), one);
    touch.impulses.col(k) = one;
  }
  pair_.by_jumps(touch.by_y, touch.by_v);
  touch.by_y = (axes.transpose() * touch.by_y).eval();
  touch.by_v = (axes.transpose() * touch.by_v).eval();
  return touch;
}

void RigidStop::take_impulse(double impulse, double mass) {
  mass_ = mass;
  impulse_ += impulse;
}

bool RigidStop::at_accumulation(int index) {
  held_ = index == kTouch;
  return true;
}

bool RigidStop::has_sunk() const { return deepest_ > kLiftHeight; }

void RigidStop::record(History& history) const {
  Stop::record(history);
  history.put(impulse_name_, "N s", impulse_);
}

std::vector<double> RigidStop::save() const {
  std::vector<double> state{held_ ? 1.0 : 0.0, mass_, impulse_};
  for (const double value : Stop::save()) state.push_back(value);
  return state;
}

void RigidStop::restore(const std::vector<double>& state) {
  if (state.size() < 3) throw InputError(name() + ": the saved state belongs to another scene");
  held_ = state[0] != 0.0;
  mass_ = state[1];
  impulse_ = state[2];
  Stop::restore({state.begin() + 3, state.end()});
}

}  // namespace clatter::dynamics
