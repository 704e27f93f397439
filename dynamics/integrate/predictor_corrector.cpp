// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/predictor_corrector.hpp"

namespace clatter::dynamics {

PredictorCorrector::PredictorCorrector(System& system, const StepOptions& options)
    : Integrator(system, options) {
  solver_.inform(now_, stage_);
}

void PredictorCorrector::forget_history() {
  Integrator::forget_history();
  dt_before_ = 0.0;
}

Integrator::Verdict PredictorCorrector::attempt(double dt, const StageOperator& op) {
  const double half = 0.5 * dt;
  system_.begin_step(now_.time);
  stage_.time = now_.time + dt;
  stage_.kappa = stage_.weights[0] = half;
  const bool has_history = dt_before_ > 0.0;
  const double ratio = has_history ? dt / dt_before_ : 0.0;
  eta_predicted_ = now_.eta + dt * (1.0 + 0.5 * ratio) * now_.v;
  v_predicted_ = now_.v + dt * (1.0 + 0.5 * ratio) * now_.a;
  if (has_history) {
    eta_predicted_ -= half * ratio * v_before_;
    v_predicted_ -= half * ratio * a_before_;
  }
  eta_tilde_ = now_.eta + half * now_.v;
  v_tilde_ = now_.v + half * now_.a;
  if (!solver_.solve(stage_, op, eta_tilde_, v_tilde_, eta_predicted_, stages_[0])) return failed();
  if (!options_.fixed) {
    // Without history the predictor is Euler's: half its difference is the term that it lacks.
    const double share = has_history ? 1.0 / (3.0 * (1.0 + 1.0 / ratio)) : 0.5;
    e_eta_ = share * (stages_[0].eta - eta_predicted_);
    e_v_ = share * (stages_[0].v - v_predicted_);
    system_.interface(e_eta_, e_y_);
    last_error_ = measure(e_y_);
    if (!(last_error_ <= 1.0)) return Verdict::kError;
  }
  system_.finish_stage(stage_);
  if (observer_ != nullptr) observer_->stage(1, stages_[0]);
  return Verdict::kAccepted;
}

void PredictorCorrector::accepted() {
  dt_before_ = now_.time - before_.time;
  v_before_ = before_.v;
  a_before_ = before_.a;
}

}  // namespace clatter::dynamics
