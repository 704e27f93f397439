// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The nonlinear equations of one implicit stage, y = y_pred + S f(y, v).
#include <Eigen/Core>
#include <string>

#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/stage_matrix.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// Simplified Newton iteration on y with J = I - S (df/dy + df/dv / kappa), kept while it
/// contracts.
///
/// Convergence: the last increment is below `kConverged` of what the error test allows, measured in
/// displacement and, divided by kappa, in velocity. The returned forces are f + (df/dy) dy of the
/// last increment: they and y satisfy the linear part of the stage exactly, so momentum is balanced
/// to rounding despite the remaining Newton error. An iteration that does not converge is a
/// rejected step, never an accepted one.
class StageNewton {
 public:
  enum class Outcome { kConverged, kDiverged, kRefused };
  struct Result {
    Outcome outcome;
    std::string reason;  // of a refusal
    int worst = -1;      // y with the largest increment
  };

  StageNewton(System& system, const ErrorWeights& weights, StepStatistics& statistics);

  /// `y` holds the guess and becomes the solution; `f` the forces. y_tilde gives v = (y -
  /// y~)/kappa.
  Result solve(const Stage& stage, const StageOperator& op, const Eigen::VectorXd& y_pred,
               const Eigen::VectorXd& y_tilde, Eigen::VectorXd& y, Eigen::VectorXd& f);
  /// J^{-1} x with the matrix of the last stage; the corresponding change of forces is T J^{-1} x.
  void solve_linear(Eigen::VectorXd& x) const { matrix_.solve(x); }
  const StageMatrix& matrix() const { return matrix_; }
  /// Drops the matrix; the next stage forms a new one.
  void forget() { kappa_ = 0.0; }

 private:
  bool factor(const StageOperator& op);
  double norm(const Eigen::VectorXd& dy, double kappa, int& worst) const;

  System& system_;
  const ErrorWeights& weights_;
  StepStatistics& statistics_;
  StageMatrix matrix_;
  double kappa_ = 0.0;  // of the kept matrix; 0: none
};

}  // namespace clatter::dynamics
