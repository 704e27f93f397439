// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/integrate/generalised_alpha.hpp"

#include <cmath>
#include <map>

namespace clatter::bench {

using dynamics::StageOperator;
using dynamics::Tableau;

const Tableau& GeneralisedAlpha::tableau(double rho) {
  static std::map<double, Tableau> tables;
  const auto [found, is_new] = tables.try_emplace(rho);
  if (is_new) {
    found->second = dynamics::predictor_corrector();
    found->second.name = "generalised-alpha";
    found->second.d = 2.0 / ((1.0 + rho) * (3.0 - rho));
  }
  return found->second;
}

namespace {

dynamics::StepOptions with_tableau(dynamics::StepOptions options, double rho) {
  options.method = &GeneralisedAlpha::tableau(rho);
  return options;
}

}  // namespace

GeneralisedAlpha::GeneralisedAlpha(dynamics::System& system, const dynamics::StepOptions& options,
                                   double rho)
    : Integrator(system, with_tableau(options, rho)),
      a_m_(0.5 * (3.0 - rho) / (1.0 + rho)),
      a_f_(1.0 / (1.0 + rho)),
      gamma_(1.0 / (1.0 + rho)) {
  // Of Y: x''' c beyond the rate where it is; of x: 1/6 less what Y gives.
  const double shift = a_f_ - a_m_;
  const double c = 0.5 * a_f_ - 0.5 * shift * shift - a_m_ * (shift + 0.5);
  error_ = std::abs(1.0 / 6.0 - (0.5 * shift * shift + c + gamma_ * (shift + 0.5)));
}

void GeneralisedAlpha::forget_history() {
  Integrator::forget_history();
  dt_before_ = 0.0;
}

GeneralisedAlpha::Verdict GeneralisedAlpha::attempt(double dt, const StageOperator& op) {
  system_.begin_step(now_.time);
  stage_.time = now_.time + dt;
  stage_.kappa = op.kappa();
  stage_.weights[0] = dt - op.kappa();
  const bool has_history = dt_before_ > 0.0;
  const double ratio = has_history ? dt / dt_before_ : 0.0;
  eta_predicted_ = now_.eta + dt * (1.0 + 0.5 * ratio) * now_.v;
  v_predicted_ = now_.v + dt * (1.0 + 0.5 * ratio) * now_.a;
  Eigen::VectorXd Y_eta = now_.v, Y_v = now_.a;
  if (has_history) {
    eta_predicted_ -= 0.5 * dt * ratio * v_before_;
    v_predicted_ -= 0.5 * dt * ratio * a_before_;
    const double moved = (a_f_ - a_m_) * (dt - dt_before_) / dt_before_;
    Y_eta = Y_eta_ + moved * (now_.v - v_before_);
    Y_v = Y_v_ + moved * (now_.a - a_before_);
  }
  const double per_rate = dt * gamma_ / a_m_;
  const double of_Y = dt * (1.0 - gamma_) - per_rate * (1.0 - a_m_);
  const double of_rate = per_rate * (1.0 - a_f_);
  eta_tilde_ = now_.eta + of_Y * Y_eta + of_rate * now_.v;
  v_tilde_ = now_.v + of_Y * Y_v + of_rate * now_.a;
  if (!solver_.solve(stage_, op, eta_tilde_, v_tilde_, eta_predicted_, stages_[0])) return failed();
  const auto& end = stages_[0];
  next_eta_ = (a_f_ * end.v + (1.0 - a_f_) * now_.v - (1.0 - a_m_) * Y_eta) / a_m_;
  next_v_ = (a_f_ * end.a + (1.0 - a_f_) * now_.a - (1.0 - a_m_) * Y_v) / a_m_;
  if (!options_.fixed) {
    const double predictor = has_history ? 1.0 / 6.0 + 0.25 / ratio : 0.5;
    const double share = has_history ? error_ / (predictor + error_) : 0.5;
    eta_predicted_ = share * (end.eta - eta_predicted_);
    v_predicted_ = share * (end.v - v_predicted_);
    op.filter(eta_predicted_, v_predicted_, e_eta_);
    e_v_ = (e_eta_ - eta_predicted_) / op.kappa();
    system_.interface(e_eta_, e_y_);
    solver_.newton().solve_linear(op, e_y_);
    last_error_ = measure(e_y_);
    if (!(last_error_ <= 1.0)) return Verdict::kError;
  }
  system_.finish_stage(stage_);
  return Verdict::kAccepted;
}

void GeneralisedAlpha::accepted() {
  dt_before_ = now_.time - before_.time;
  v_before_ = before_.v;
  a_before_ = before_.a;
  Y_eta_ = next_eta_;
  Y_v_ = next_v_;
}

}  // namespace clatter::bench
