// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What all integration methods have in common: steps under error control, failures, events.
#include <Eigen/Core>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/derived_error.hpp"
#include "dynamics/integrate/error_estimate.hpp"
#include "dynamics/integrate/event_search.hpp"
#include "dynamics/integrate/missed_impulse.hpp"
#include "dynamics/integrate/missed_table.hpp"
#include "dynamics/integrate/rounding_floor.hpp"
#include "dynamics/integrate/stage_operator.hpp"
#include "dynamics/integrate/stage_solver.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/statistics.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/integrate/tableau.hpp"

namespace clatter::dynamics {

/// Method and step size limits.
struct StepOptions {
  const Tableau* method = &tr_bdf2();
  Accuracy accuracy;
  double largest = 1e-4;     // largest step of the ladder [s]
  double smallest = 1e-10;   // floor: below it the run ends with a NumericsError [s]
  double first = 1e-7;       // length of the starting stage and first step [s]
  bool exact_modes = false;  // free modes move exactly (exact_mode.hpp); of two-stage methods
  bool fixed = false;        // every step has `largest`; no error test (order tests)
};

/// Is called with each finished stage; used for the energy balance.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  /// Stage 0 is the accepted state at the start, and after an event; then the implicit stages of
  /// each attempted step.
  virtual void stage(int index, const StageState& state) = 0;
  /// The step of length `dt` is accepted: sums with dt b_i over its stages can be formed.
  virtual void accept(double dt) = 0;
};

/// Integrates a System in error-controlled steps dt = largest 2^(-k/2).
///
/// A step is accepted when the largest error over its limit (Accuracy) is at most 1. After an error
/// rejection the next step is 0.9 / error^(1/3) of this one (all methods are of second order);
/// after a Newton failure or refusal it is halved and may not grow for some steps, twice as many
/// after each consecutive failure (hard case T4). Below `smallest` a NumericsError names the
/// coordinate and its elements.
class Integrator {
 public:
  virtual ~Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// Starts from (eta, v) at `time` by one implicit Euler stage of length `first`, which gives
  /// consistent accelerations and rates of internal states.
  void start(double time, const Eigen::VectorXd& eta, const Eigen::VectorXd& v);
  /// One accepted step, not beyond `limit` nor beyond an event: a step in which an event function
  /// changes its sign is repeated to end where it does, the element changes its mode there, and the
  /// motion goes on from the state that it left. NumericsError when events accumulate and their
  /// element has no mode for it.
  void step(double limit);
  /// Resets the history of earlier steps (kept matrix, hold on growth), as after a resume.
  virtual void forget_history();

  const StageState& state() const { return now_; }
  /// Both ends of the last step: where it began, and where it arrived before an event changed the
  /// velocities there.
  const StageState& previous() const { return before_; }
  const StageState& arrived() const { return jumped_ ? arrived_ : now_; }
  const StepStatistics& statistics() const { return statistics_; }
  StepStatistics& statistics() { return statistics_; }
  /// The accumulated velocity error of each body, of steps with an error test.
  const ErrorEstimate& estimate() const { return estimate_; }
  ErrorEstimate& estimate() { return estimate_; }
  const ErrorWeights& weights() const { return weights_; }
  void set_observer(StageObserver* observer) { observer_ = observer; }

  /// The rung on the ladder of steps; together with the state it suffices to resume.
  int rung() const { return rung_; }
  /// Continues from the state of an earlier run.
  void resume(const StageState& state, int rung);

 protected:
  enum class Verdict { kAccepted, kError, kNewton, kRefused };

  Integrator(System& system, const StepOptions& options);
  /// One step of length dt from now(); its stages are kept in stages_[0 ..], the last one is the
  /// end. Sets last_error_, e_eta_ and e_v_ unless a stage failed.
  virtual Verdict attempt(double dt, const StageOperator& op) = 0;
  /// A step was accepted; before_ and now_ are its ends.
  virtual void accepted() {}

  /// Solves stage `index` and finishes it (elements, observer) if `finish`.
  Verdict failed() const;
  /// Largest of e_y, the errors of the bodies, and where asked for those of forces and
  /// accelerations, over their limits; infinite when not finite.
  double measure(const Eigen::VectorXd& e_y);
  const StageState& end() const { return stages_[tableau_->stages - 1]; }

  System& system_;
  StepOptions options_;
  const Tableau* tableau_;
  ErrorWeights weights_;
  StepStatistics statistics_;
  StageSolver solver_;
  StageObserver* observer_ = nullptr;
  StageState before_, now_;
  std::vector<StageState> stages_;
  double last_error_ = 0.0;
  Eigen::VectorXd e_eta_, e_v_;  // local errors of the last attempt

 private:
  const StageOperator& ladder_operator(int rung);
  double ladder_step(int rung) const;
  int rung_for(double dt) const;
  std::unique_ptr<StageOperator> make_operator(double kappa);
  bool find_event();
  void pass_event();
  bool accumulates(int element, int index);
  Eigen::VectorXd impulses_at(const Event& event);
  void refresh_rates();
  void take_step(double dt, double time);
  void after_acceptance(double dt);
  void after_rejection(Verdict verdict);
  [[noreturn]] void give_up(double dt) const;

  ErrorEstimate estimate_;
  DerivedError derived_;
  MissedImpulse missed_;
  MissedTable missed_table_;
  RoundingFloor floor_;
  EventSearch events_;
  std::optional<Event> event_;  // in the step under way: it ends there
  StageState arrived_;          // at the event that ended the last step
  bool jumped_ = false;         // it ended by an event
  struct CloseEvents {
    double last = -std::numeric_limits<double>::infinity();  // [s]
    int count = 0;  // in a row that follow within a few smallest steps
  };
  std::map<std::pair<int, int>, CloseEvents> close_events_;  // of element and function
  std::map<int, std::unique_ptr<StageOperator>> operators_;
  int worst_ = -1;
  int rung_ = 0;
  int hold_ = 0;      // accepted steps before the step may grow again
  int failures_ = 0;  // Newton failures and refusals in a row
};

/// The method of options.method.
std::unique_ptr<Integrator> make_integrator(System& system, const StepOptions& options);

}  // namespace clatter::dynamics
