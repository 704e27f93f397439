// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pulses of loads between the stages of a step.
#include <Eigen/Core>
#include <vector>

#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/integrate/tableau.hpp"

namespace clatter::dynamics {

/// The error estimate compares forces at the stages: it cannot see a pulse between them (hard case
/// S2). Where a load's table has several rows within a step, its impulse by the method's weights is
/// compared with that by the table.
class MissedImpulse {
 public:
  /// Keeps references.
  MissedImpulse(const System& system, const ErrorWeights& weights, const Tableau& tableau);

  /// The difference of a step that begins at `begin` [s] and has these stages, as the error of a
  /// velocity over its limit. Takes no memory.
  double error(double begin, const std::vector<StageState>& stages);

 private:
  const System& system_;
  const ErrorWeights& weights_;
  const Tableau& tableau_;
  const Eigen::VectorXd no_displacement_;  // N
  Eigen::VectorXd velocity_;               // N
};

}  // namespace clatter::dynamics
