// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The generalised-alpha method, tried against the kernel's methods.
#include <Eigen/Core>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::bench {

/// Generalised-alpha for first-order systems (Jansen, Whiting and Hulbert 2000) with the equations
/// of motion in equilibrium at the end of the step (Arnold and Bruels 2007): one implicit stage,
/// second order, spectral radius `rho` at infinite frequency (1: trapezoidal rule, 0: BDF2).
///
///   a_m Y_1 + (1 - a_m) Y_0 = a_f x'_1 + (1 - a_f) x'_0,   x_1 = x_0 + dt ((1 - g) Y_0 + g Y_1)
///
/// Y is the rate at a_f - a_m steps from the end of a step; where the step changes it is moved
/// along the difference of the last two rates. The error is the part of the difference from the
/// Adams-Bashforth predictor that the leading terms give, filtered by the stage's equations. For
/// elements without states of their own.
class GeneralisedAlpha : public dynamics::Integrator {
 public:
  GeneralisedAlpha(dynamics::System& system, const dynamics::StepOptions& options, double rho);
  void forget_history() override;
  /// The tableau of one stage that has the kernel form its operators; it outlives all integrators.
  static const dynamics::Tableau& tableau(double rho);

 private:
  Verdict attempt(double dt, const dynamics::StageOperator& op) override;
  void accepted() override;

  double a_m_, a_f_, gamma_, error_;  // error_: of the method, in dt^3 x'''
  dynamics::Stage stage_{0.0, 0.0, 1, {0.0}};
  double dt_before_ = 0.0;                           // 0: there is no step before this one
  Eigen::VectorXd v_before_, a_before_;              // rates at its start
  Eigen::VectorXd Y_eta_, Y_v_, next_eta_, next_v_;  // Y of displacements and velocities
  Eigen::VectorXd eta_tilde_, v_tilde_, eta_predicted_, v_predicted_, e_y_;
};

}  // namespace clatter::bench
