#pragma once
// What "accurate enough" means, from one number.
#include <Eigen/Core>

#include "dynamics/system.hpp"

namespace clatter::dynamics {

/// The local error of a step may reach `tolerance` times these scales. The defaults are those of a
/// piston in its bore: 10 um of clearance, crossed with 0.1 m/s, on an arm of 50 mm.
struct Accuracy {
  double tolerance = 1e-3;
  double displacement_scale = 1e-5;  // [m]
  double velocity_scale = 0.1;       // [m/s]
  double arm = 0.05;                 // turns rotations into displacements [m]
};

/// Weights of errors: entry times error is 1 at the limit.
struct ErrorWeights {
  Eigen::VectorXd displacement;       // per y
  Eigen::VectorXd velocity;           // per y
  Eigen::VectorXd body_displacement;  // per body, of the modal norm |eta| = sqrt(m) u_rms
  Eigen::VectorXd body_velocity;
};

inline ErrorWeights error_weights(const System& system, const Accuracy& accuracy) {
  const int n = system.interface_size();
  const auto n_b = static_cast<int>(system.bodies().size());
  ErrorWeights w{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n_b),
                 Eigen::VectorXd(n_b)};
  const double per_displacement = 1.0 / (accuracy.tolerance * accuracy.displacement_scale);
  const double per_velocity = 1.0 / (accuracy.tolerance * accuracy.velocity_scale);
  for (int i = 0; i < n; ++i) {
    const double arm = system.is_rotation(i) ? accuracy.arm : 1.0;
    w.displacement(i) = arm * per_displacement;
    w.velocity(i) = arm * per_velocity;
  }
  for (int b = 0; b < n_b; ++b) {
    const double root = std::sqrt(system.bodies()[static_cast<size_t>(b)].mass);
    w.body_displacement(b) = per_displacement / root;
    w.body_velocity(b) = per_velocity / root;
  }
  return w;
}

}  // namespace clatter::dynamics
