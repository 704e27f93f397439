// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Error limits from one tolerance.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// The local error of a step may reach `tolerance` times these scales. The defaults are those of a
/// piston in its bore: 10 um of clearance, crossed with 0.1 m/s, on an arm of 50 mm.
struct Accuracy {
  double tolerance = 1e-3;
  double displacement_scale = 1e-5;  // of every interface coordinate, so of every gap [m]
  double velocity_scale = 0.1;       // of the lightest body as a rigid body [m/s]
  double arm = 0.05;                 // converts rotations to displacements [m]
};

/// Weights of errors: entry times error is 1 at the limit.
///
/// Displacements are checked coordinate by coordinate. Velocities are checked by the kinetic energy
/// of their error over all bodies, relative to the lightest body at the velocity scale: so a patch
/// of some grams that a filling film cell pushes does not limit the step of the entire engine.
struct ErrorWeights {
  Eigen::VectorXd displacement;  // per y
  Eigen::VectorXd velocity;      // per y: of the smallest modal velocity that moves it so fast
  double modal_displacement;     // of the modal norm |eta| = sqrt(m) u_rms over all bodies
  double modal_velocity;
};

inline ErrorWeights error_weights(const System& system, const Accuracy& accuracy) {
  const int n = system.interface_size();
  ErrorWeights w{Eigen::VectorXd(n), Eigen::VectorXd(n), 0.0, 0.0};
  const double per_displacement = 1.0 / (accuracy.tolerance * accuracy.displacement_scale);
  for (int i = 0; i < n; ++i) {
    w.displacement(i) = (system.is_rotation(i) ? accuracy.arm : 1.0) * per_displacement;
  }
  double lightest = std::numeric_limits<double>::infinity();
  for (const auto& body : system.bodies()) lightest = std::min(lightest, body.mass);
  w.modal_displacement = per_displacement / std::sqrt(lightest);
  w.modal_velocity = 1.0 / (accuracy.tolerance * accuracy.velocity_scale * std::sqrt(lightest));
  // The smallest |v| with P_i v = u is |u| / |P_i|.
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const auto& rows = system.rows(b);
    const auto inertia = system.bodies()[static_cast<size_t>(b)].inertia.asDiagonal();
    for (size_t i = 0; i < rows.size(); ++i) {
      const double reach = (system.P(b).row(static_cast<Eigen::Index>(i)) * inertia).norm();
      w.velocity(rows[i]) = reach > 0.0 ? w.modal_velocity / reach : 0.0;
    }
  }
  return w;
}

}  // namespace clatter::dynamics
