// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/dirk.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

Dirk::Dirk(System& system, const StepOptions& options) : Integrator(system, options) {
  for (Stage* stage : {&first_, &second_}) solver_.inform(now_, *stage);
}

Integrator::Verdict Dirk::attempt(double dt, const StageOperator& op) {
  const Tableau& A = *tableau_;
  const double kappa = A.d * dt;
  system_.begin_step(now_.time);
  const double c = A.c_1 * dt, w_10 = A.a_10 * dt, w_20 = A.a_20 * dt, w_21 = A.a_21 * dt;
  first_.time = now_.time + c;
  first_.kappa = second_.kappa = kappa;
  first_.weights[0] = w_10;
  op.rates(now_, eta_rate_[0], v_rate_[0]);
  eta_tilde_ = now_.eta + w_10 * eta_rate_[0];
  v_tilde_ = now_.v + w_10 * v_rate_[0];
  eta_guess_ = now_.eta + c * now_.v + 0.5 * c * c * now_.a;
  StageState& mid = stages_[0];
  if (!solver_.solve(first_, op, eta_tilde_, v_tilde_, eta_guess_, mid)) return failed();
  system_.finish_stage(first_);
  if (observer_ != nullptr) observer_->stage(1, mid);

  second_.time = now_.time + dt;
  second_.weights[0] = w_20;
  second_.weights[1] = w_21;
  op.rates(mid, eta_rate_[1], v_rate_[1]);
  eta_tilde_ = now_.eta + w_20 * eta_rate_[0] + w_21 * eta_rate_[1];
  v_tilde_ = now_.v + w_20 * v_rate_[0] + w_21 * v_rate_[1];
  eta_guess_ = mid.eta + (dt - c) * mid.v + 0.5 * (dt - c) * (dt - c) * mid.a;
  if (!solver_.solve(second_, op, eta_tilde_, v_tilde_, eta_guess_, stages_[1])) return failed();
  if (!options_.fixed) {
    last_error_ = error(dt, op);
    if (!(last_error_ <= 1.0)) return Verdict::kError;
  }
  system_.finish_stage(second_);
  if (observer_ != nullptr) observer_->stage(2, stages_[1]);
  return Verdict::kAccepted;
}

double Dirk::error(double dt, const StageOperator& op) {
  const auto& b = tableau_->b;
  const auto& b_hat = tableau_->b_hat;
  const double d0 = dt * (b[0] - b_hat[0]), d1 = dt * (b[1] - b_hat[1]),
               d2 = dt * (b[2] - b_hat[2]);
  op.rates(stages_[1], eta_rate_[2], v_rate_[2]);
  eta_tilde_ = d0 * eta_rate_[0] + d1 * eta_rate_[1] + d2 * eta_rate_[2];
  v_tilde_ = d0 * v_rate_[0] + d1 * v_rate_[1] + d2 * v_rate_[2];
  op.filter(eta_tilde_, v_tilde_, e_eta_);
  e_v_ = (e_eta_ - eta_tilde_) / op.kappa();
  system_.interface(e_eta_, e_y_);
  solver_.newton().solve_linear(op, e_y_);
  return measure(e_y_);
}

}  // namespace clatter::dynamics
