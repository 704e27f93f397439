// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Estimate of each body's velocity error from the local errors of all steps.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/integrate/accuracy.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/law/archive.hpp"

namespace clatter::dynamics {

/// One body's motion and its accumulated error.
struct BodyError {
  std::string name;
  double speed = 0.0;     // largest of the run: |v| / sqrt(m), root mean square over the body [m/s]
  double estimate = 0.0;  // of the error of v, relative to `speed`
  double step_limit = 0.0;  // largest error of one step that passes the test, relative to `speed`
  double velocity_scale = 0.0;  // of the body itself [m/s]; 0: that of the run
  bool at_rest = false;         // no faster than the rounding of its position in a step
};

/// Sums local errors mode by mode. A mode's local error is a point of its phase plane,
///   e_k = (e_v, omega e_eta),
/// which rotates with the mode and decays with its damping delta, so that in the worst case (all in
/// phase, as errors of a frequency are)
///   G_k(t + dt) = G_k(t) exp(-delta dt / 2) + |e_k|,
/// and a body's error is the largest |G| over its modes. Elements couple and damp modes: where they
/// dominate, as in contact, this is an upper bound. Quasi-static modes are excluded.
class ErrorEstimate {
 public:
  explicit ErrorEstimate(const System& system);

  /// An accepted step of length `dt` [s] with local errors e_eta, e_v, modal, N, that led to `end`.
  void add(double dt, const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
           const StageState& end);
  /// All bodies that moved; `weights` are those of the error test.
  std::vector<BodyError> bodies(const ErrorWeights& weights) const;
  long long steps() const { return steps_; }
  /// What was summed, for checkpoints.
  void archive(Archive& archive);

 private:
  const System* system_;
  Eigen::VectorXd sums_;  // G, N
  // Per body: max |G|, max |v|, and the largest rounding of positions over the step.
  std::vector<double> largest_, velocity_, noise_;
  long long steps_ = 0;
};

/// Warnings for bodies whose motion is too small for the absolute tolerance: the error of a step
/// may exceed 1 % of the motion, and the estimate is above 1 %. Each gives the velocity scale that
/// reduces the error to about 1 %.
std::vector<std::string> accuracy_warnings(const std::vector<BodyError>& bodies,
                                           const Accuracy& accuracy, long long steps);

}  // namespace clatter::dynamics
