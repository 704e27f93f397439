// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/dirk.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

constexpr double kSafety = 0.9;
constexpr double kOrder = 3.0;  // of the embedded difference in dt
constexpr int kLongestHold = 64;
/// Part of a step within which an event counts as one at its end, or at its beginning.
constexpr double kNear = 1e-9;
/// Events accumulate when this many in a row follow within so many smallest steps.
constexpr int kMostClose = 4;
constexpr double kClose = 1e4;

}  // namespace

Dirk::Dirk(System& system, const StepOptions& options)
    : system_(system),
      options_(options),
      weights_(error_weights(system, options.accuracy)),
      newton_(system, weights_, statistics_),
      estimate_(system),
      events_(system) {}

double Dirk::ladder_step(int rung) const { return options_.largest * std::pow(2.0, -0.5 * rung); }

int Dirk::rung_for(double dt) const {
  // The longest rung not above dt; the small excess keeps exact values on their rung.
  const double exact = 2.0 * std::log2(options_.largest / dt);
  return std::max(0, static_cast<int>(std::ceil(exact - 1e-9)));
}

std::unique_ptr<StageOperator> Dirk::make_operator(double kappa) {
  const Stopwatch clock;
  auto op = std::make_unique<StageOperator>(system_, kappa);
  ++statistics_.operators;
  statistics_.operator_seconds += clock.seconds();
  return op;
}

const StageOperator& Dirk::ladder_operator(int rung) {
  auto& op = operators_[rung];
  if (!op) op = make_operator(options_.method->d * ladder_step(rung));
  return *op;
}

void Dirk::start(double time, const VectorXd& eta, const VectorXd& v) {
  system_.begin_step(time);
  const Stage stage{time + options_.first, options_.first, 0, {}};
  const auto op = make_operator(options_.first);
  const VectorXd y_guess = system_.interface(eta);
  if (!solve_stage(stage, *op, eta, v, y_guess, now_)) {
    throw NumericsError(
        fmt::format("start at {:.6g} s: no consistent state was found ({})", time,
                    last_newton_.reason.empty() ? "Newton did not converge" : last_newton_.reason));
  }
  system_.finish_stage(stage);
  system_.accept_step(now_.time);
  if (observer_ != nullptr) observer_->stage(0, now_);
  if (events_.any()) events_.start(now_);
  before_ = now_;
  rung_ = options_.fixed ? 0 : rung_for(std::min(options_.first, options_.largest));
}

void Dirk::resume(const StageState& state, int rung) {
  now_ = before_ = state;
  rung_ = rung;
  forget_history();
}

void Dirk::forget_history() {
  newton_.forget();
  hold_ = 0;
  failures_ = 0;
}

bool Dirk::solve_stage(const Stage& stage, const StageOperator& op, const VectorXd& eta_tilde,
                       const VectorXd& v_tilde, const VectorXd& y_guess, StageState& out) {
  ++statistics_.stages;
  VectorXd F = system_.load_force(stage.time);
  const auto settle = [&] {
    out.a = op.acceleration(eta_tilde, v_tilde, F);
    out.v = v_tilde + stage.kappa * out.a;
    out.eta = eta_tilde + stage.kappa * out.v;
  };
  settle();
  const VectorXd y_pred = system_.interface(out.eta), y_tilde = system_.interface(eta_tilde);
  out.y = y_guess;
  VectorXd f;
  last_newton_ = newton_.solve(stage, op, y_pred, y_tilde, out.y, f);
  if (last_newton_.outcome != StageNewton::Outcome::kConverged) return false;
  system_.add_interface_force(f, F);
  settle();
  out.time = stage.time;
  out.y = system_.interface(out.eta);
  out.v_y = system_.interface(out.v);
  return true;
}

Dirk::Verdict Dirk::attempt(double dt, const StageOperator& op) {
  const Tableau& A = *options_.method;
  const double kappa = A.d * dt;
  system_.begin_step(now_.time);
  const auto failed = [&] {
    return last_newton_.outcome == StageNewton::Outcome::kRefused ? Verdict::kRefused
                                                                  : Verdict::kNewton;
  };
  const double c = A.c_1 * dt, w_10 = A.a_10 * dt, w_20 = A.a_20 * dt, w_21 = A.a_21 * dt;
  const Stage first{now_.time + c, kappa, 1, {w_10}};
  if (!solve_stage(first, op, now_.eta + w_10 * now_.v, now_.v + w_10 * now_.a,
                   now_.y + c * now_.v_y, stages_[0])) {
    return failed();
  }
  system_.finish_stage(first);
  if (observer_ != nullptr) observer_->stage(1, stages_[0]);

  const Stage second{now_.time + dt, kappa, 2, {w_20, w_21}};
  const StageState& mid = stages_[0];
  if (!solve_stage(second, op, now_.eta + w_20 * now_.v + w_21 * mid.v,
                   now_.v + w_20 * now_.a + w_21 * mid.a, mid.y + (dt - c) * mid.v_y, stages_[1])) {
    return failed();
  }
  if (!options_.fixed) {
    last_error_ = error(dt, op);
    if (!(last_error_ <= 1.0)) return Verdict::kError;
  }
  system_.finish_stage(second);
  if (observer_ != nullptr) observer_->stage(2, stages_[1]);
  return Verdict::kAccepted;
}

double Dirk::error(double dt, const StageOperator& op) {
  const auto& b = options_.method->b;
  const auto& b_hat = options_.method->b_hat;
  const double d0 = dt * (b[0] - b_hat[0]), d1 = dt * (b[1] - b_hat[1]),
               d2 = dt * (b[2] - b_hat[2]);
  const VectorXd e_eta = d0 * now_.v + d1 * stages_[0].v + d2 * stages_[1].v;
  const VectorXd e_v = d0 * now_.a + d1 * stages_[0].a + d2 * stages_[1].a;
  e_eta_ = op.filter(e_eta, e_v);
  double largest = 0.0;
  if (system_.interface_size() > 0) {
    VectorXd e_y = system_.interface(e_eta_);
    newton_.solve_linear(e_y);
    largest = e_y.cwiseAbs().cwiseProduct(weights_.displacement).maxCoeff(&worst_);
  }
  e_v_ = (e_eta_ - e_eta) / op.kappa();
  const double modal = modal_error(system_, weights_, e_eta_, e_v_);
  return modal <= largest ? largest : modal;  // NaN is neither
}

void Dirk::step(double limit) {
  const Stopwatch clock;
  event_.reset();
  for (;;) {
    double dt = ladder_step(rung_);
    const double end = event_ ? std::min(limit, event_->time) : limit;
    const double left = end - now_.time;
    Verdict verdict;
    // The last two steps before the limit leave the ladder, so that neither of them is tiny.
    const bool near_limit = left < 2.0 * dt * (1.0 - 1e-9);
    if (near_limit) {
      dt = left <= dt * (1.0 + 1e-9) ? left : 0.5 * left;
      verdict = attempt(dt, *make_operator(options_.method->d * dt));
    } else {
      verdict = attempt(dt, ladder_operator(rung_));
    }
    if (verdict == Verdict::kAccepted && find_event()) continue;
    if (verdict == Verdict::kAccepted) {
      std::swap(before_, now_);
      std::swap(now_, stages_[1]);
      if (system_.normalise(now_.eta)) system_.interface(now_.eta, now_.y);
      if (near_limit && dt == left) now_.time = end;
      system_.accept_step(now_.time);
      if (observer_ != nullptr) observer_->accept(dt);
      if (!options_.fixed) estimate_.add(dt, e_eta_, e_v_, now_.v);
      ++statistics_.accepted;
      statistics_.smallest_step = std::min(statistics_.smallest_step, dt);
      statistics_.largest_step = std::max(statistics_.largest_step, dt);
      after_acceptance(dt);
      if (event_ && now_.time >= event_->time) pass_event();
      statistics_.total_seconds += clock.seconds();
      return;
    }
    if (near_limit) rung_ = std::max(rung_, rung_for(dt));
    after_rejection(verdict);
  }
}

/// Looks for an event in the step that was just accepted; true when that step is not taken, because
/// it is to end earlier or an event happened at its beginning.
bool Dirk::find_event() {
  if (!events_.any()) return false;
  const StageState& end = stages_[1];
  const double dt = end.time - now_.time, near = std::max(kNear * dt, 1e-15 * std::abs(end.time));
  event_ = events_.first(now_, end);
  if (!event_) return false;
  if (event_->time <= now_.time + near) {
    pass_event();
    return true;
  }
  const bool at_end = event_->time >= end.time - near;
  if (at_end) event_->time = end.time;
  return !at_end;
}

/// The state has reached an event: the element changes its mode, impulses change velocities, and
/// the rates become those of the new mode.
void Dirk::pass_event() {
  const Event event = *event_;
  event_.reset();
  ForceElement& element = system_.element(event.element);
  const auto& at = element.coordinates();
  ++statistics_.events;
  close_events_ = now_.time - last_event_ <= kClose * options_.smallest ? close_events_ + 1 : 0;
  last_event_ = now_.time;
  VectorXd impulse = VectorXd::Zero(static_cast<Eigen::Index>(at.size()));
  if (close_events_ < kMostClose) {
    element.at_event(event.index, now_.time, gather(now_.y, at), gather(now_.v_y, at),
                     system_.mobility(at), impulse);
  } else if (element.at_accumulation(event.index)) {
    close_events_ = 0;
  } else {
    throw NumericsError(fmt::format("time {:.9g} s: events of {} follow each other without end",
                                    now_.time, element.name()));
  }
  VectorXd f = VectorXd::Zero(system_.interface_size());
  for (size_t i = 0; i < at.size(); ++i) f(at[i]) += impulse(static_cast<Eigen::Index>(i));
  VectorXd jump = VectorXd::Zero(system_.modes());
  system_.add_interface_force(f, jump);
  now_.v += system_.inertia().cwiseProduct(jump);
  system_.interface(now_.v, now_.v_y);
  refresh_rates();
  newton_.forget();
  events_.passed(event, now_);
}

/// Accelerations, and rates of states, of the current state by explicit evaluation.
void Dirk::refresh_rates() {
  VectorXd f;
  system_.evaluate({now_.time, options_.first, 0, {}}, now_.y, now_.v_y, false, f);
  VectorXd F = system_.load_force(now_.time);
  system_.add_interface_force(f, F);
  const auto& damping = system_.damping();
  for (Eigen::Index k = 0; k < F.size(); ++k) {
    if (system_.inertia()(k) > 0.0) {
      now_.a(k) = F(k) - damping(k) * now_.v(k) - system_.omega_squared()(k) * now_.eta(k);
    } else if (system_.second_order()(k) == 0.0) {
      now_.v(k) = F(k) / damping(k);
    }
  }
  system_.interface(now_.v, now_.v_y);
  if (observer_ != nullptr) observer_->stage(0, now_);
}

void Dirk::after_acceptance(double dt) {
  failures_ = 0;
  if (options_.fixed) return;
  if (hold_ > 0) {
    --hold_;
    return;
  }
  const double factor = kSafety * std::pow(std::max(last_error_, 1e-6), -1.0 / kOrder);
  const int target_rung = rung_for(dt * factor);
  // Grows by at most a factor of two.
  if (target_rung < rung_) rung_ = std::max(target_rung, rung_ - 2);
}

void Dirk::after_rejection(Verdict verdict) {
  const double dt = ladder_step(rung_);
  if (verdict == Verdict::kError) {
    ++statistics_.rejected_error;
    const double factor = std::max(0.1, kSafety * std::pow(last_error_, -1.0 / kOrder));
    rung_ = std::max(rung_ + 1, std::isfinite(factor) ? rung_for(dt * factor) : rung_ + 4);
    hold_ = std::max(hold_, 1);
  } else {
    ++(verdict == Verdict::kRefused ? statistics_.rejected_refused : statistics_.rejected_newton);
    if (verdict == Verdict::kRefused) ++statistics_.refusals[last_newton_.reason];
    worst_ = last_newton_.worst;
    rung_ += 2;
    failures_ = std::min(failures_ + 1, 6);
    hold_ = std::min(kLongestHold, 2 << failures_);
  }
  if (options_.fixed || ladder_step(rung_) < options_.smallest) give_up(dt);
}

void Dirk::give_up(double dt) const {
  std::vector<std::string> names;
  for (int e = 0; worst_ >= 0 && e < system_.elements(); ++e) {
    const auto& at = system_.element(e).coordinates();
    if (std::find(at.begin(), at.end(), worst_) != at.end()) {
      names.push_back(system_.element(e).name());
    }
  }
  const std::string worst =
      worst_ < 0
          ? std::string("no single coordinate")
          : fmt::format("{} (y = {:.6g}, v = {:.6g}) under {}", system_.coordinate_name(worst_),
                        now_.y(worst_), now_.v_y(worst_),
                        names.empty() ? "no element" : fmt::format("{}", fmt::join(names, ", ")));
  throw NumericsError(fmt::format(
      "time {:.9g} s: a step of {:.3g} s failed and the next is below the floor of {:.3g} s; "
      "worst: "
      "{}{}; {} steps accepted, {} rejected by error, {} by Newton, {} refused",
      now_.time, dt, options_.smallest, worst,
      last_newton_.reason.empty() ? "" : "; " + last_newton_.reason, statistics_.accepted,
      statistics_.rejected_error, statistics_.rejected_newton, statistics_.rejected_refused));
}

}  // namespace clatter::dynamics
