// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One implicit stage: linear bodies and the forces between them.
#include <Eigen/Core>

#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/newton.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// Solves x = x~ + kappa x' for displacements, velocities and states: modes by modes in closed form
/// under the forces that StageNewton finds.
class StageSolver {
 public:
  StageSolver(System& system, const ErrorWeights& weights, StepStatistics& statistics);

  /// @param eta_tilde, v_tilde, eta_guess N. False: `last()` says why; `out` is then not to be
  /// used.
  bool solve(const Stage& stage, const StageOperator& op, const Eigen::VectorXd& eta_tilde,
             const Eigen::VectorXd& v_tilde, const Eigen::VectorXd& eta_guess, StageState& out);
  const StageNewton::Result& last() const { return last_; }
  StageNewton& newton() { return newton_; }
  /// Tells a stage what solve() knows of it, and the state where its step begins.
  void inform(const StageState& begin, Stage& stage) const {
    stage.y_begin = &begin.y;
    stage.v_begin = &begin.v_y;
    stage.v_known = &v_known_;
  }

 private:
  bool is_finite(const StageState& state);

  System& system_;
  StepStatistics& statistics_;
  StageNewton newton_;
  StageNewton::Result last_{StageNewton::Outcome::kConverged, "", "", -1};
  Eigen::VectorXd F_, y_pred_, y_tilde_, v_known_, f_;
};

}  // namespace clatter::dynamics
