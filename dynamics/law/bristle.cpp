// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/law/bristle.hpp"

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Bristle::Force Bristle::evaluate(const Stage& stage, const Vector2d& slip, double normal) {
  const Vector2d before = z_.known(stage);
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
  z_.set_rate(stage, (force.value - k_ * before) / rate_stiffness);
  return force;
}

void Bristle::accept_step() {
  z_.accept_step();
  slid_ = slides_;
}

double Bristle::lost(const Vector2d& slip) const {
  return (k_ * z_.value() + c_ * z_.rate()).dot(slip) - k_ * z_.value().dot(z_.rate());
}

std::vector<double> Bristle::save() const {
  std::vector<double> state = z_.save();
  state.push_back(slid_ ? 1.0 : 0.0);
  return state;
}

void Bristle::restore(std::span<const double> state) {
  z_.restore(state);
  slid_ = slides_ = state.back() != 0.0;
}

}  // namespace clatter::dynamics
