// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/stage_solver.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

StageSolver::StageSolver(System& system, const ErrorWeights& weights, StepStatistics& statistics)
    : system_(system), statistics_(statistics), newton_(system, weights, statistics) {}

bool StageSolver::solve(const Stage& stage, const StageOperator& op, const VectorXd& eta_tilde,
                        const VectorXd& v_tilde, const VectorXd& eta_guess, StageState& out) {
  ++statistics_.stages;
  system_.load_force(stage.time, F_);
  op.settle(eta_tilde, v_tilde, F_, out);
  system_.interface<4>({&out.eta, &eta_tilde, &eta_guess, &v_tilde},
                       {&y_pred_, &y_tilde_, &out.y, &v_known_});
  last_ = newton_.solve(stage, op, y_pred_, y_tilde_, out.y, f_);
  if (last_.outcome != StageNewton::Outcome::kConverged) return false;
  system_.add_interface_force(f_, F_);
  op.settle(eta_tilde, v_tilde, F_, out);
  if (!is_finite(out)) return false;
  out.time = stage.time;
  system_.interface<2>({&out.eta, &out.v}, {&out.y, &out.v_y});
  return true;
}

// No later test may lose a NaN (hard case N2): of a table, or of an overflow.
bool StageSolver::is_finite(const StageState& state) {
  const auto finite = [&](Eigen::Index first, Eigen::Index count) {
    return (state.eta + state.v + state.a).segment(first, count).allFinite();
  };
  if (finite(0, state.eta.size())) return true;
  last_.outcome = StageNewton::Outcome::kDiverged;
  for (size_t b = 0; b < system_.bodies().size(); ++b) {
    const ModalBody& body = system_.bodies()[b];
    if (finite(system_.mode_offset(static_cast<int>(b)), body.modes())) continue;
    last_.kind = body.name + ": the motion is not finite";
    break;
  }
  return false;
}

}  // namespace clatter::dynamics
