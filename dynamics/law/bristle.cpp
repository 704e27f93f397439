// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/law/bristle.hpp"

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Bristle::Force Bristle::evaluate(const Stage& stage, const Vector2d& slip, double normal) {
  Vector2d before = accepted_;
  for (int j = 0; j < stage.index; ++j) before += stage.weights[j] * rates_[j];
  const double rate_stiffness = k_ * stage.kappa + c_;
  const Vector2d trial = k_ * before + rate_stiffness * slip;
  const double size = trial.norm(), limit = kinetic_ * normal;
  Force force{trial, rate_stiffness * Matrix2d::Identity(), Vector2d::Zero()};
  slides_ = size > (slid_ ? limit : at_rest_ * normal);
  if (slides_) {
    const Vector2d direction = trial / size;
    force.value = limit * direction;
    force.by_normal = kinetic_ * direction;
    force.by_slip =
        limit / size * rate_stiffness * (Matrix2d::Identity() - direction * direction.transpose());
  }
  rate_ = (force.value - k_ * before) / rate_stiffness;
  // Stage 0 is a state, not the end of a step.
  z_ = stage.index == 0 ? before : Vector2d(before + stage.kappa * rate_);
  if (stage.index == 0) rates_[0] = rate_;
  return force;
}

void Bristle::finish_stage(const Stage& stage) {
  rates_[stage.index] = rate_;
  last_stage_ = stage.index;
}

void Bristle::accept_step() {
  accepted_ = z_;
  slid_ = slides_;
  rates_[0] = rates_[last_stage_];
}

double Bristle::lost(const Vector2d& slip) const {
  return (k_ * z_ + c_ * rate_).dot(slip) - k_ * z_.dot(rate_);
}

std::vector<double> Bristle::save() const {
  return {accepted_.x(), accepted_.y(), rates_[0].x(), rates_[0].y(), slid_ ? 1.0 : 0.0};
}

void Bristle::restore(std::span<const double> state) {
  accepted_ = z_ = {state[0], state[1]};
  rates_[0] = rate_ = {state[2], state[3]};
  slid_ = slides_ = state[4] != 0.0;
}

}  // namespace clatter::dynamics
