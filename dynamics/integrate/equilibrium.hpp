// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Static equilibrium of a system.
#include <Eigen/Core>
#include <string>

#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

struct EquilibriumOptions {
  double residual = 1e-6;      // largest unbalanced force [N], moment [N m]
  double rate = 1e-3;          // largest rate of a state, in its scale [1/s]
  double longest_move = 1e-4;  // of a coordinate in the first iteration, by rotations with their
                               // arm; later ten times as long while the residual does not rise [m]
  double arm = 0.05;           // of all rotations: links of a chain turn by 2 mrad at most [m]
  double first_time = 1e-5;    // pseudo-time step of the first iteration [s]
  int most_iterations = 3000;
};

struct Equilibrium {
  bool found = false;
  int iterations = 0;
  double residual = 0.0;       // largest unbalanced force [N], moment [N m]
  int worst = -1;              // modal coordinate where it is; -1: it is not finite
  std::string refused;         // why an element refused the last state; empty: none did
  Eigen::VectorXd eta;         // N
  Eigen::VectorXd unbalanced;  // of each modal coordinate, in the measure of `residual`, N
};

/// Finds the state near `eta` (N) at which nothing moves at `time`: forces of all elements at rest
/// and loads balance, and states of first order have no rate.
///
/// Pseudo-transient continuation (Kelley and Keyes 1998): implicit Euler steps with the bodies'
/// masses, of which only the first Newton iteration is done and whose velocity is forgotten,
///   (M / tau^2 - df/dq) dq = f,
/// of limited length, with tau grown as the residual falls (switched evolution relaxation). Where
/// the unbalanced forces change their sign from one iteration to the next without getting smaller,
/// only a part of a step is gone, halved each time. It follows the way of the bodies through
/// contacts that close and open, where Newton's method alone jumps, and ends in Newton's method.
///
/// Prescribed motions have to rest: elements see the velocities of what is driven.
Equilibrium find_equilibrium(System& system, double time, const Eigen::VectorXd& eta,
                             const EquilibriumOptions& options = {});

}  // namespace clatter::dynamics
