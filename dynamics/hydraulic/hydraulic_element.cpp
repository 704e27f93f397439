// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/hydraulic_element.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

/// Coordinates of the axis, then those of the chamber.
std::vector<int> with_own(std::vector<int> all, const std::vector<int>& own) {
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

}  // namespace

ModalBody make_chamber_body(const std::string& name, const Chamber& chamber, double time,
                            double travel, double pressure, double pressure_scale) {
  const bool ball = chamber.valve().has_moving_ball();
  const Eigen::Index n = ball ? 2 : 1;
  const double content = chamber.content(travel, pressure);
  ModalBody body;
  body.name = name;
  body.shapes = Eigen::MatrixXd::Identity(n, n);
  body.omega_squared = body.damping = body.inertia = VectorXd::Zero(n);
  body.damping(0) = 1.0;
  body.rigid = Eigen::MatrixXd::Zero(n, 6);
  body.is_rotation.assign(n, 0);
  body.state_error.assign(n, StateError::kNone);
  body.state_error[0] = StateError::kOwn;
  body.state_scale = VectorXd::Ones(n);
  body.state_scale(0) = content * pressure_scale / chamber.spec().oil.modulus;
  body.eta_start = body.v_start = VectorXd::Zero(n);
  body.eta_start(0) = content;
  ChamberState start;
  chamber.move(time, travel, content, 0.0, start);
  body.v_start(0) = start.inflow.value;
  if (!ball) return body;
  body.mass = chamber.spec().valve.ball_mass();
  body.shapes(1, 1) = 1.0 / std::sqrt(body.mass);
  body.inertia(1) = 1.0;
  return body;
}

HydraulicElement::HydraulicElement(std::string name, PlungerAxis axis, Chamber chamber,
                                   const PlungerSpring& spring, HydraulicModel model,
                                   std::vector<int> own, double start, double time)
    : ForceElement(with_own(axis.coordinates(), own)),
      name_(std::move(name)),
      axis_(std::move(axis)),
      chamber_(std::move(chamber)),
      spring_(spring),
      model_(model),
      plunger_size_(axis_.size()),
      has_ball_(own.size() > 1) {
  constant_force_ = force(start, chamber_.supply(time)).first;
  std::string prefix = name_ + "_";
  std::replace(prefix.begin(), prefix.end(), ' ', '_');
  const char* names[] = {"pressure",  "travel",     "force",       "content",
                         "leak_flow", "valve_flow", "relief_flow", "lift"};
  for (size_t k = 0; k < recorded_.size(); ++k) recorded_[k] = prefix + names[k];
}

double HydraulicElement::own_lift(const VectorXd& y) const {
  return has_ball_ ? y(plunger_size_ + 1) : 0.0;
}

std::pair<double, double> HydraulicElement::force(double travel, double pressure) const {
  const double pushed = chamber_.spec().area() * (pressure - chamber_.spec().outside);
  const double depth = in_stop(travel);
  std::pair<double, double> sum{pushed + stops_.stiffness * depth,
                                depth != 0.0 ? -stops_.stiffness : 0.0};
  const double spring = spring_.force - spring_.rate * travel;
  if (spring <= 0.0) return sum;
  sum.first += spring;
  sum.second -= spring_.rate;
  return sum;
}

double HydraulicElement::in_stop(double travel) const {
  if (travel < stops_.ends[0]) return stops_.ends[0] - travel;
  return std::min(stops_.ends[1] - travel, 0.0);
}

void HydraulicElement::move(double time, const VectorXd& y, const VectorXd& v, Instant& at) const {
  axis_.move(time, y, v);
  at.travel = axis_.travel();
  if (is_hydraulic()) {
    at.content = y(plunger_size_);
    chamber_.move(time, at.travel, at.content, own_lift(y), at.chamber);
  } else {
    at.chamber.pressure = {chamber_.supply(time)};
  }
  at.force = model_ == HydraulicModel::kConstantForce
                 ? constant_force_
                 : force(at.travel, at.chamber.pressure.value).first;
}

void HydraulicElement::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                                bool with_tangent, Response& response) {
  const int n = plunger_size_;
  const Eigen::Index all = y.size();
  time_ = stage.time;
  move(time_, y, v, last_);
  response.force.resize(all);
  response.force.head(n) = last_.force * axis_.direction();
  if (with_tangent) {
    response.tangent.setZero(all, all);
    row_.setZero(all);
    const ByMotion& p = last_.chamber.pressure;
    const double area = chamber_.spec().area();
    double by_travel = area * p.by_travel + force(last_.travel, p.value).second;
    if (model_ == HydraulicModel::kConstantForce) by_travel = 0.0;
    row_.head(n) = by_travel * axis_.gradient();
    if (is_hydraulic()) row_(n) = area * p.by_content;
    if (has_ball_) row_(n + 1) = area * p.by_lift;
    response.tangent.topRows(n).noalias() = axis_.direction() * row_;
    axis_.add_curvature(last_.force, response.tangent.topLeftCorner(n, n));
  }
  if (is_hydraulic()) add_own(stage, y, v, with_tangent, response);
}

void HydraulicElement::add_own(const Stage& stage, const VectorXd& y, const VectorXd& v,
                               bool with_tangent, Response& response) const {
  const int n = plunger_size_;
  const ByMotion &p = last_.chamber.pressure, &inflow = last_.chamber.inflow;
  response.force(n) = inflow.value;
  const double seat = chamber_.spec().valve.seat_area();
  BallForce ball;
  if (has_ball_) {
    ball = chamber_.valve().ball(y(n + 1), v(n + 1));
    response.force(n + 1) = ball.value + seat * (last_.chamber.supply - p.value);
  }
  if (!with_tangent) return;
  auto& tangent = response.tangent;
  tangent.row(n).head(n) = inflow.by_travel * axis_.gradient();
  tangent(n, n) = inflow.by_content;
  if (!has_ball_) return;
  tangent(n, n + 1) = inflow.by_lift;
  tangent.row(n + 1).head(n) = -seat * p.by_travel * axis_.gradient();
  tangent(n + 1, n) = -seat * p.by_content;
  tangent(n + 1, n + 1) = ball.by_lift + ball.by_speed / stage.kappa - seat * p.by_lift;
}

Power HydraulicElement::power(const VectorXd& y, const VectorXd& v) const {
  move(time_, y, v, at_);
  Power power;
  power.input = axis_.driven_power(at_.force);
  if (model_ == HydraulicModel::kConstantForce) {
    power.input += at_.force * axis_.rate();
    return power;
  }
  // Of the spring: the work that it can still do.
  const double spring = spring_.force - spring_.rate * at_.travel;
  if (spring > 0.0)
    power.stored =
        spring_.rate > 0.0 ? 0.5 * spring * spring / spring_.rate : -spring_.force * at_.travel;
  const double depth = in_stop(at_.travel);
  power.stored += 0.5 * stops_.stiffness * depth * depth;
  const double outside = chamber_.spec().outside;
  if (!is_hydraulic()) {
    power.input += chamber_.spec().area() * (at_.chamber.pressure.value - outside) * axis_.rate();
    return power;
  }
  power.stored += chamber_.stored(at_.chamber, at_.content);
  power.lost = chamber_.lost(at_.chamber);
  power.input += chamber_.input(at_.chamber);
  if (!has_ball_) return power;
  const int ball = plunger_size_ + 1;
  const BallForce on_ball = chamber_.valve().ball(y(ball), v(ball));
  power.stored += on_ball.stored;
  power.lost += on_ball.lost;
  power.input += chamber_.spec().valve.seat_area() * (at_.chamber.supply - outside) * v(ball);
  return power;
}

void HydraulicElement::record(History& history) const {
  const ChamberState& at = accepted_.chamber;
  history.put(recorded_[0], "Pa", at.pressure.value);
  history.put(recorded_[1], "m", accepted_.travel);
  history.put(recorded_[2], "N", accepted_.force);
  if (!is_hydraulic()) return;
  history.put(recorded_[3], "kg", accepted_.content);
  history.put(recorded_[4], "m3/s", at.leak_flow);
  history.put(recorded_[5], "m3/s", at.valve_flow);
  history.put(recorded_[6], "m3/s", at.relief_flow);
  history.put(recorded_[7], "m", at.lift);
}

}  // namespace clatter::dynamics
