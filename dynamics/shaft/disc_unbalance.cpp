// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/disc_unbalance.hpp"

#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Vector2d quarter_on(const Vector2d& r) { return {-r.y(), r.x()}; }

}  // namespace

DiscUnbalance::DiscUnbalance(std::string name, std::vector<int> coordinates, double unbalance,
                             double phase, double angle, double speed)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      unbalance_(unbalance),
      phase_(phase),
      accepted_(momenta(Vector3d(0.0, 0.0, angle), Vector3d(0.0, 0.0, speed))),
      stage_(accepted_) {}

Vector2d DiscUnbalance::radial(double angle) const {
  return {std::cos(angle + phase_), std::sin(angle + phase_)};
}

Vector3d DiscUnbalance::momenta(const VectorXd& y, const VectorXd& v) const {
  const Vector2d t = quarter_on(radial(y(2)));
  Vector3d both;
  both << unbalance_ * v(2) * t, unbalance_ * t.dot(v.head<2>());
  return both;
}

void DiscUnbalance::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                             bool with_tangent, Response& response) {
  const Vector2d r = radial(y(2)), t = quarter_on(r);
  const double spin = v(2), outward = r.dot(v.head<2>()), along = t.dot(v.head<2>());
  if (stage.index == 0 && started_) {
    rate_ = rates_[0];  // after an event: the state itself
  } else {
    stage_ = momenta(y, v);
    Vector3d before = accepted_;
    for (int j = 0; j < stage.index; ++j) before += stage.weights[j] * rates_[j];
    rate_ = (stage_ - before) / stage.kappa;
  }
  response.force = -rate_;
  response.force(2) -= unbalance_ * spin * outward;
  if (!with_tangent) return;
  const double per = 1.0 / stage.kappa, U = unbalance_;
  response.tangent.setZero(3, 3);
  response.tangent.col(2).head<2>() = -per * U * (per * t - spin * r);
  response.tangent.row(2).head<2>() = -per * U * (per * t + spin * r).transpose();
  response.tangent(2, 2) = -U * spin * along;
}

void DiscUnbalance::finish_stage(const Stage& stage) {
  rates_[stage.index] = rate_;
  last_stage_ = stage.index;
}

void DiscUnbalance::accept_step(double) {
  started_ = true;
  accepted_ = stage_;
  rates_[0] = rates_[last_stage_];
}

Power DiscUnbalance::power(const VectorXd& y, const VectorXd& v) const {
  return {v(2) * momenta(y, v)(2), 0.0, 0.0};
}

std::vector<double> DiscUnbalance::save() const {
  return {accepted_(0), accepted_(1), accepted_(2), rates_[0](0), rates_[0](1), rates_[0](2)};
}

void DiscUnbalance::restore(const std::vector<double>& state) {
  if (state.size() != 6) throw InputError(name_ + ": the saved state belongs to another scene");
  accepted_ = stage_ = {state[0], state[1], state[2]};
  rates_[0] = {state[3], state[4], state[5]};
  started_ = true;
}

}  // namespace clatter::dynamics
