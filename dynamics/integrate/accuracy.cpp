// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/accuracy.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

namespace {

/// Limits of one body's errors.
struct Limits {
  double displacement, velocity, arm;  // [m], [m/s], [m]
};

Limits limits_of(const ModalBody& body, const Accuracy& accuracy) {
  const auto own = [](double value, double general) { return value > 0.0 ? value : general; };
  return {accuracy.tolerance * own(body.displacement_scale, accuracy.displacement_scale),
          accuracy.tolerance * own(body.velocity_scale, accuracy.velocity_scale),
          own(body.arm, accuracy.arm)};
}

double state_limit(const ModalBody& body, int mode, const Limits& limits, double tolerance) {
  const double scale = body.state_scale(mode);
  switch (body.state_error[mode]) {
    case StateError::kRotation:
      return scale * limits.displacement / limits.arm;
    case StateError::kSpin:
      return scale * limits.velocity / limits.arm;
    default:
      return scale * tolerance;
  }
}

}  // namespace

ErrorWeights error_weights(const System& system, const Accuracy& accuracy) {
  const int n = system.interface_size();
  ErrorWeights w{Eigen::VectorXd::Zero(n),
                 Eigen::VectorXd::Zero(n),
                 Eigen::VectorXd::Zero(system.modes()),
                 Eigen::VectorXd::Zero(system.modes()),
                 {}};
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const ModalBody& body = system.bodies()[b];
    const Limits limits = limits_of(body, accuracy);
    const double root = body.mass > 0.0 ? std::sqrt(body.mass) : 1.0;
    w.velocity_limit.push_back(limits.velocity * root);
    const int first = system.mode_offset(b);
    for (int k = 0; k < body.modes(); ++k) {
      if (body.is_state(k)) continue;
      w.modal_displacement(first + k) = 1.0 / (limits.displacement * root);
      w.modal_velocity(first + k) = body.inertia(k) / w.velocity_limit.back();
    }
    const auto& rows = system.rows(b);
    for (size_t i = 0; i < rows.size(); ++i) {
      const int y = rows[i];
      const Eigen::RowVectorXd P = system.P(b).row(static_cast<Eigen::Index>(i));
      Eigen::Index state = 0;
      P.cwiseAbs().maxCoeff(&state);
      if (body.is_state(static_cast<int>(state))) {
        w.displacement(y) = 1.0 / (std::abs(P(state)) * state_limit(body, static_cast<int>(state),
                                                                    limits, accuracy.tolerance));
        continue;
      }
      const double per_metre = system.mode_of(y) >= 0  ? 1.0 / root
                               : system.is_rotation(y) ? limits.arm
                                                       : 1.0;
      w.displacement(y) = per_metre / limits.displacement;
      // The smallest |v| with P_i v = u is |u| / |P_i|.
      const double reach = P.cwiseProduct(body.inertia.transpose()).norm();
      if (reach > 0.0) w.velocity(y) = 1.0 / (w.velocity_limit.back() * reach);
    }
  }
  return w;
}

double modal_error(const System& system, const ErrorWeights& weights, const Eigen::VectorXd& e_eta,
                   const Eigen::VectorXd& e_v) {
  double largest = 0.0;
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const int first = system.mode_offset(b);
    const int count = system.bodies()[b].modes();
    const auto norm = [&](const Eigen::VectorXd& weight, const Eigen::VectorXd& error) {
      return std::sqrt((weight.array() * error.array()).segment(first, count).square().sum());
    };
    for (const double value :
         {norm(weights.modal_displacement, e_eta), norm(weights.modal_velocity, e_v)})
      if (!(value <= largest)) largest = value;  // a NaN stays: nothing is above it
    if (std::isnan(largest)) return largest;
  }
  return largest;
}

}  // namespace clatter::dynamics
