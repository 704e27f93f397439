// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/rounding_floor.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

/// Writes the entries of `error` above those of `noise` to `kept`, 0 for the others.
template <class Noise>
void keep(const VectorXd& error, const Noise& noise, VectorXd& kept) {
  kept = (error.array().abs() > noise).select(error, 0.0);
}

/// Size of the terms of a displacement: its value and its change in the step.
auto terms(const VectorXd& x0, const VectorXd& x1, const VectorXd& v0, const VectorXd& v1,
           double dt) {
  return x0.array().abs().max(x1.array().abs()) + dt * v0.array().abs().max(v1.array().abs());
}

}  // namespace

RoundingFloor::RoundingFloor(const System& system)
    : eta_(system.modes()), v_(system.modes()), y_(system.interface_size()) {}

void RoundingFloor::apply(const StageState& begin, const StageState& end, const VectorXd& e_eta,
                          const VectorXd& e_v, const VectorXd& e_y) {
  const double dt = end.time - begin.time;
  const auto eta = kRoundingNoise * terms(begin.eta, end.eta, begin.v, end.v, dt);
  keep(e_eta, eta, eta_);
  keep(e_v, eta / dt + kRoundingNoise * dt * begin.a.array().abs(), v_);
  keep(e_y, kRoundingNoise * terms(begin.y, end.y, begin.v_y, end.v_y, dt), y_);
}

}  // namespace clatter::dynamics
