// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/integrator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "dynamics/integrate/dirk.hpp"
#include "dynamics/integrate/impact.hpp"
#include "dynamics/integrate/predictor_corrector.hpp"

namespace clatter::dynamics {

using Eigen::VectorXd;

namespace {

constexpr double kSafety = 0.9;
constexpr double kOrder = 3.0;  // of the local error in dt
constexpr int kLongestHold = 64;
/// Part of a step within which an event counts as one at its end, or at its beginning.
constexpr double kNear = 1e-9;
/// Events of a function accumulate when so many in a row each follow within so many smallest steps.
constexpr int kMostClose = 4;
constexpr double kClose = 1e4;

}  // namespace

std::unique_ptr<Integrator> make_integrator(System& system, const StepOptions& options) {
  if (options.method->stages == 1) return std::make_unique<PredictorCorrector>(system, options);
  return std::make_unique<Dirk>(system, options);
}

Integrator::Integrator(System& system, const StepOptions& options)
    : system_(system),
      options_(options),
      tableau_(options.method),
      weights_(error_weights(system, options.accuracy)),
      solver_(system, weights_, statistics_),
      stages_(static_cast<size_t>(options.method->stages)),
      estimate_(system),
      derived_(system, options.accuracy),
      missed_(system, weights_, *tableau_),
      missed_table_(system, weights_, *tableau_),
      floor_(system),
      events_(system) {}

double Integrator::ladder_step(int rung) const {
  return options_.largest * std::pow(2.0, -0.5 * rung);
}

int Integrator::rung_for(double dt) const {
  // The longest rung not above dt; the small excess keeps exact values on their rung.
  const double exact = 2.0 * std::log2(options_.largest / dt);
  return std::max(0, static_cast<int>(std::ceil(exact - 1e-9)));
}

std::unique_ptr<StageOperator> Integrator::make_operator(double kappa) {
  const Stopwatch clock;
  auto op =
      std::make_unique<StageOperator>(system_, kappa, options_.exact_modes ? tableau_->d : 0.0);
  ++statistics_.operators;
  statistics_.operator_seconds += clock.seconds();
  return op;
}

const StageOperator& Integrator::ladder_operator(int rung) {
  auto& op = operators_[rung];
  if (!op) op = make_operator(tableau_->d * ladder_step(rung));
  return *op;
}

void Integrator::start(double time, const VectorXd& eta, const VectorXd& v) {
  system_.start_frames(time);
  system_.begin_step(time);
  const Stage stage{time + options_.first, options_.first, 0, {}};
  const StageOperator op(system_, options_.first);
  if (!solver_.solve(stage, op, eta, v, eta, now_)) {
    const auto& last = solver_.last();
    throw NumericsError(fmt::format("start at {:.6g} s: no consistent state was found ({})", time,
                                    last.kind.empty() ? "Newton did not converge" : last.reason()));
  }
  system_.finish_stage(stage);
  system_.accept_step(now_.time);
  if (observer_ != nullptr) observer_->stage(0, now_);
  if (events_.any()) events_.start(now_);
  before_ = now_;
  system_.restart_frames(before_, now_);
  rung_ = options_.fixed ? 0 : rung_for(std::min(options_.first, options_.largest));
}

void Integrator::resume(const StageState& state, int rung) {
  now_ = before_ = state;
  jumped_ = false;
  close_events_.clear();
  if (events_.any()) events_.start(now_);
  rung_ = rung;
  forget_history();
}

void Integrator::forget_history() {
  solver_.newton().forget();
  hold_ = 0;
  failures_ = 0;
}

Integrator::Verdict Integrator::failed() const {
  return solver_.last().outcome == StageNewton::Outcome::kRefused ? Verdict::kRefused
                                                                  : Verdict::kNewton;
}

double Integrator::measure(const VectorXd& e_y) {
  const LargestEntry largest = largest_entry(e_y.cwiseProduct(weights_.displacement));
  worst_ = largest.at;
  const double modal = modal_error(system_, weights_, e_eta_, e_v_);
  const double derived = derived_.measure(e_eta_, e_v_, e_y);
  if (!std::isfinite(largest.value + modal + derived))
    return std::numeric_limits<double>::infinity();
  const double other =
      std::max({derived, missed_.error(now_.time, stages_), missed_table_.error(now_, stages_)});
  const double all = std::max({largest.value, modal, other});
  if (all <= 1.0) return all;
  floor_.apply(now_, end(), e_eta_, e_v_, e_y);
  return std::max({largest_entry(floor_.y().cwiseProduct(weights_.displacement)).value,
                   modal_error(system_, weights_, floor_.eta(), floor_.v()), other});
}

void Integrator::step(double limit) {
  const Stopwatch clock;
  event_.reset();
  for (;;) {
    double dt = ladder_step(rung_);
    const double goal = event_ ? std::min(limit, event_->time) : limit;
    const double left = goal - now_.time;
    Verdict verdict;
    // The last two steps before the limit leave the ladder, so that neither of them is tiny.
    const bool near_limit = left < 2.0 * dt * (1.0 - 1e-9);
    if (near_limit) {
      dt = left <= dt * (1.0 + 1e-9) ? left : 0.5 * left;
      verdict = attempt(dt, *make_operator(tableau_->d * dt));
    } else {
      verdict = attempt(dt, ladder_operator(rung_));
    }
    if (verdict == Verdict::kAccepted) {
      if (find_event()) continue;
      take_step(dt, near_limit && dt == left ? goal : end().time);
      statistics_.total_seconds += clock.seconds();
      return;
    }
    if (near_limit) rung_ = std::max(rung_, rung_for(dt));
    after_rejection(verdict);
  }
}

/// The state moves to the end of the accepted attempt.
void Integrator::take_step(double dt, double time) {
  std::swap(before_, now_);
  std::swap(now_, stages_[tableau_->stages - 1]);
  now_.time = time;
  system_.restart_frames(before_, now_);
  system_.accept_step(time);
  if (observer_ != nullptr) observer_->accept(dt);
  if (!options_.fixed) estimate_.add(dt, e_eta_, e_v_, now_);
  ++statistics_.accepted;
  statistics_.smallest_step = std::min(statistics_.smallest_step, dt);
  statistics_.largest_step = std::max(statistics_.largest_step, dt);
  after_acceptance(dt);
  accepted();
  const bool ends_by_event = event_ && now_.time >= event_->time;
  jumped_ = ends_by_event;
  if (!ends_by_event) return;
  arrived_ = now_;
  pass_event();
}

/// Looks for an event in the step that was just accepted; true when that step is not taken, because
/// it is to end earlier or an event happened at its beginning.
bool Integrator::find_event() {
  if (!events_.any()) return false;
  const double dt = end().time - now_.time;
  const double near = std::max(kNear * dt, 1e-15 * std::abs(end().time));
  event_ = events_.first(now_, end());
  if (!event_) return false;
  // No step to an event is shorter than the floor.
  if (event_->time <= now_.time + std::max(near, options_.smallest)) {
    pass_event();
    return true;
  }
  const bool at_end = event_->time >= end().time - near;
  if (at_end) event_->time = end().time;
  return !at_end;
}

/// Counts an event; true where events of its function follow each other too closely to go on.
bool Integrator::accumulates(int element, int index) {
  ++statistics_.events;
  CloseEvents& close = close_events_[{element, index}];
  close.count = now_.time - close.last <= kClose * options_.smallest ? close.count + 1 : 0;
  close.last = now_.time;
  if (close.count < kMostClose) return false;
  if (!system_.element(element).at_accumulation(index))
    throw NumericsError(fmt::format("time {:.9g} s: events of {} follow each other without end",
                                    now_.time, system_.element(element).name()));
  close.count = 0;
  return true;
}

/// The impulses of an event, n_y; the elements that have part in it change their modes.
VectorXd Integrator::impulses_at(const Event& event) {
  ForceElement& element = system_.element(event.element);
  if (event.index == RigidContact::kTouch && dynamic_cast<RigidContact*>(&element) != nullptr) {
    Impact impact(system_, now_, event.element);
    for (const int e : impact.closing())
      if (accumulates(e, event.index)) impact.hold(e);
    return impact.solve();
  }
  if (!accumulates(event.element, event.index)) element.at_event(event.index, now_.time);
  return VectorXd::Zero(system_.interface_size());
}

/// The state has reached an event: elements change their modes, impulses change velocities, and the
/// rates become those of the new mode.
void Integrator::pass_event() {
  const Event event = *event_;
  event_.reset();
  const VectorXd f = impulses_at(event);
  VectorXd eta_jump, v_jump;
  system_.jump(now_, f, eta_jump, v_jump);
  now_.eta += eta_jump;
  now_.v += v_jump;
  system_.interface(now_.eta, now_.y);
  system_.interface(now_.v, now_.v_y);
  refresh_rates();
  system_.restart_frames(before_, now_);  // a spatial body goes on freely with its new spin
  forget_history();
  events_.passed(event, now_);
}

/// Accelerations, and rates of states, of the current state by explicit evaluation.
void Integrator::refresh_rates() {
  VectorXd f;
  system_.evaluate({now_.time, options_.first, 0, {}}, now_.y, now_.v_y, false, f);
  VectorXd F;
  system_.load_force(now_.time, F);
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

void Integrator::after_acceptance(double dt) {
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

void Integrator::after_rejection(Verdict verdict) {
  const double dt = ladder_step(rung_);
  if (verdict == Verdict::kError) {
    ++statistics_.rejected_error;
    const double factor = std::max(0.1, kSafety * std::pow(last_error_, -1.0 / kOrder));
    rung_ = std::max(rung_ + 1, std::isfinite(factor) ? rung_for(dt * factor) : rung_ + 4);
    hold_ = std::max(hold_, 1);
  } else {
    ++(verdict == Verdict::kRefused ? statistics_.rejected_refused : statistics_.rejected_newton);
    if (verdict == Verdict::kRefused) {
      RefusalCount& refusals = statistics_.refusals[solver_.last().kind];
      ++refusals.count;
      refusals.last = solver_.last().detail;
    }
    worst_ = solver_.last().worst;
    rung_ += 2;
    failures_ = std::min(failures_ + 1, 6);
    hold_ = std::min(kLongestHold, 2 << failures_);
  }
  if (options_.fixed || ladder_step(rung_) < options_.smallest) give_up(dt);
}

void Integrator::give_up(double dt) const {
  std::vector<std::string> names;
  for (int e = 0; worst_ >= 0 && e < system_.elements(); ++e) {
    const auto& at = system_.element(e).coordinates();
    if (std::find(at.begin(), at.end(), worst_) != at.end()) {
      names.push_back(system_.element(e).name());
    }
  }
  // A pulse may be shorter than the floor.
  for (const Load& load : system_.loads()) {
    const auto& rows = system_.rows(load.body);
    if (load.next_row && std::find(rows.begin(), rows.end(), worst_) != rows.end())
      names.push_back(load.term);
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
      solver_.last().kind.empty() ? "" : "; " + solver_.last().reason(), statistics_.accepted,
      statistics_.rejected_error, statistics_.rejected_newton, statistics_.rejected_refused));
}

}  // namespace clatter::dynamics
