// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The periodic motion of oscillators under forces that repeat.
#include <Eigen/Core>

#include "core/base/matrix.hpp"

namespace clatter::dynamics {

/// Motion at uniform instants, n_t x n_m each: displacements, velocities, and accelerations as
/// means over one interval around the instant.
struct PeriodicMotion {
  RowMatrix eta, v, a;
};

/// Solves eta'' + damping eta' + omega_squared eta = f with eta(t + T) = eta(t), line by line below
/// half the sampling frequency: exact for a force that has no others. (Interpolating the force in
/// time instead makes stiff modes ring at each sample.)
///
/// @param force n_t x n_m, means over the intervals around n_t = n + 1 instants `step` apart; the
/// first and the last row, half an interval each, are the two halves of one instant. T = n step.
/// @param damping >= 0, n_m [1/s]; @param omega_squared >= 0, n_m [1/s2]
/// A mode with omega_squared = 0 moves without its mean force, about zero. A mode without damping
/// has a solution unless T is a multiple of its period.
PeriodicMotion periodic_response(const RowMatrix& force, double step,
                                 const Eigen::VectorXd& omega_squared,
                                 const Eigen::VectorXd& damping);

}  // namespace clatter::dynamics
