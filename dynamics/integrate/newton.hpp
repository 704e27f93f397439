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
/// The state at which the elements were evaluated last is accepted when both its residual
/// r = y_pred + S f - y, the effect of the unbalanced forces, and the increment dy = J^{-1} r are
/// below `kConverged` (5 %) of what the error test allows, in displacement and, over kappa, in
/// velocity. dy alone says nothing where J is kept from a stiff contact that has opened (hard case
/// N1), so a matrix that was not formed in this stage must have contracted in it. Where y cannot
/// be given more finely, dy at rounding level suffices, however small the limits are. The forces
/// passed on are f + (df/dy) dy: with them P eta = y + dy exactly, which keeps stiff contacts at
/// rest. Their difference to f changes P eta by less than |r| + |dy|. An iteration that does not
/// converge is a rejected step, never an accepted one.
class StageNewton {
 public:
  enum class Outcome { kConverged, kDiverged, kRefused };
  struct Result {
    Outcome outcome;
    std::string kind, detail;  // of a refusal, or of a state that is not finite
    int worst = -1;            // y with the largest increment
    std::string reason() const { return detail.empty() ? kind : kind + ", " + detail; }
  };

  StageNewton(System& system, const ErrorWeights& weights, StepStatistics& statistics);

  /// `y` holds the guess and becomes the state of the last evaluation, in the rows that elements
  /// touch; `f` the forces. y_tilde gives v = (y - y~)/kappa.
  Result solve(const Stage& stage, const StageOperator& op, const Eigen::VectorXd& y_pred,
               const Eigen::VectorXd& y_tilde, Eigen::VectorXd& y, Eigen::VectorXd& f);
  /// J^{-1} x with the matrix of the last stage; the corresponding change of forces is T J^{-1} x.
  void solve_linear(const StageOperator& op, Eigen::VectorXd& x) const { matrix_.solve(op, x); }
  const StageMatrix& matrix() const { return matrix_; }
  /// Drops the matrix; the next stage forms a new one.
  void forget() { kappa_ = 0.0; }

 private:
  bool factor(const StageOperator& op);
  bool is_rounding(const Eigen::VectorXd& y) const;
  void correct(const StageOperator& op, const Eigen::VectorXd& y_pred, const Eigen::VectorXd& y,
               const Eigen::VectorXd& f);

  System& system_;
  const ErrorWeights& weights_;
  StepStatistics& statistics_;
  StageMatrix matrix_;
  std::vector<int> all_;                    // y
  const std::vector<int>* rows_ = nullptr;  // y that the current iteration corrects
  Eigen::VectorXd residual_, dy_;           // of those
  Eigen::VectorXd v_, moved_;               // n_y
  double kappa_ = 0.0;                      // of the kept matrix; 0: none
};

}  // namespace clatter::dynamics
