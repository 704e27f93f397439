// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A method that is exact for the linear part, tried against the kernel's methods.
#include <Eigen/Core>
#include <Eigen/LU>
#include <map>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::bench {

/// Exponential trapezoidal rule (variation of constants, Hochbruck and Ostermann 2010): each mode
/// moves exactly under forces that are linear over the step, those at its end being implicit.
///
///   (eta, v)_1 = E (eta, v)_0 + w_0 F_0 + w_1 F_1,   y_1 = y_p + S f_1,   v_1 = v_p + S_v f_1
///
/// The error is what the second difference of the forces gives. For modes with inertia and elements
/// without states or events.
class Exponential : public dynamics::Integrator {
 public:
  Exponential(dynamics::System& system, const dynamics::StepOptions& options);
  void forget_history() override;

 private:
  /// By mode, of one step length: E and the weights of the forces at both ends.
  struct Modes {
    Eigen::MatrixX2d eta, v;          // rows of E
    Eigen::MatrixX2d from_0, from_1;  // (eta, v) per force
    Eigen::MatrixXd S, S_v;           // n_y x n_y
  };
  Verdict attempt(double dt, const dynamics::StageOperator& op) override;
  void accepted() override;
  const Modes& modes_of(double dt);
  bool solve(const dynamics::Stage& stage, const Modes& modes);
  void factor(const dynamics::Stage& stage, const Modes& modes);
  Eigen::VectorXd modal(const Eigen::VectorXd& f, double time) const;

  std::map<double, Modes> known_;
  Eigen::PartialPivLU<Eigen::MatrixXd> matrix_;
  double factored_for_ = 0.0;             // the step length of the matrix
  Eigen::VectorXd f_, y_pred_, v_pred_;   // forces on y at the end; motion without them
  Eigen::VectorXd F_0_, F_1_, F_before_;  // modal forces at the ends of this step and before
  double dt_before_ = 0.0;
};

}  // namespace clatter::bench
