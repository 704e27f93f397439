// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Diagonally implicit Runge-Kutta steps with error control.
#include <Eigen/Core>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::dynamics {

/// Two-stage methods (tableau.hpp).
///
/// Error test: e = dt sum (b_i - b^_i) x'_i for (eta, v), filtered by the linearised stage
/// equations (so stiff components do not dominate), then the largest |e_y| over interface
/// coordinates and, body by body, the norms of e_eta and of e_v, this without quasi-static modes.
class Dirk : public Integrator {
 public:
  Dirk(System& system, const StepOptions& options);

 private:
  Verdict attempt(double dt, const StageOperator& op) override;
  double error(double dt, const StageOperator& op);

  Stage first_{0.0, 0.0, 1, {0.0}}, second_{0.0, 0.0, 2, {0.0, 0.0}};
  Eigen::VectorXd eta_tilde_, v_tilde_, eta_guess_, e_y_;
  Eigen::VectorXd eta_rate_[3], v_rate_[3];  // of the start and of the stages
};

}  // namespace clatter::dynamics
