// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The paper's method: an explicit predictor, an implicit corrector, their difference as the error.
#include <Eigen/Core>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::dynamics {

/// Adams-Bashforth predictor of second order, corrected by the trapezoidal rule (section 2.1.1 of
/// the paper, which names the kind of method but not its formulas).
///
/// With r = dt / dt_before the predictor x_n + dt ((1 + r / 2) x'_n - r / 2 x'_(n-1)) and the
/// corrector differ by their leading errors, of which that of the corrector is
/// (x - x_predicted) / (3 (1 + 1 / r)) (Milne's device; Hairer, Norsett and Wanner 1993, section
/// III.5). Nothing is filtered: motions that are too fast for the predictor limit the step, as in
/// explicit methods, and elements of a scene say where they begin by events.
class PredictorCorrector : public Integrator {
 public:
  PredictorCorrector(System& system, const StepOptions& options);
  void forget_history() override;

 private:
  Verdict attempt(double dt, const StageOperator& op) override;
  void accepted() override;

  Stage stage_{0.0, 0.0, 1, {0.0}};
  double dt_before_ = 0.0;               // 0: there is no step before this one
  Eigen::VectorXd v_before_, a_before_;  // rates at its start
  Eigen::VectorXd eta_tilde_, v_tilde_, eta_predicted_, v_predicted_, e_y_;
};

}  // namespace clatter::dynamics
