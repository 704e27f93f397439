// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/missed_impulse.hpp"

#include <algorithm>

namespace clatter::dynamics {

namespace {

/// So many rows of a table within a step enclose an interval of which no stage sees anything.
constexpr int kHiddenRows = 2;

/// The rows of a load's table within a step, its ends excluded.
class RowsInStep {
 public:
  RowsInStep(const Load& load, double begin, double end) : load_(load), begin_(begin), end_(end) {
    if (!load.next_row) return;
    double row = begin;
    while (count_ < kHiddenRows && (row = load.next_row(row)) < end) ++count_;
  }
  int count() const { return count_; }
  /// Of the load over the step, by Simpson's rule from row to row: exact for linear and cubic
  /// tables.
  double integral() const {
    double sum = 0.0, from = begin_, value = load_.value(begin_);
    while (from < end_) {
      const double to = std::min(load_.next_row(from), end_), next = load_.value(to);
      sum += (to - from) / 6.0 * (value + 4.0 * load_.value(0.5 * (from + to)) + next);
      from = to;
      value = next;
    }
    return sum;
  }

 private:
  const Load& load_;
  double begin_, end_;
  int count_ = 0;
};

}  // namespace

MissedImpulse::MissedImpulse(const System& system, const ErrorWeights& weights,
                             const Tableau& tableau)
    : system_(system),
      weights_(weights),
      tableau_(tableau),
      no_displacement_(Eigen::VectorXd::Zero(system.modes())),
      velocity_(system.modes()) {}

double MissedImpulse::error(double begin, const std::vector<StageState>& stages) {
  const double end = stages[static_cast<size_t>(tableau_.stages - 1)].time;
  bool any = false;
  for (const Load& load : system_.loads()) {
    const RowsInStep rows(load, begin, end);
    if (rows.count() < kHiddenRows) continue;
    double sum = tableau_.b[0] * load.value(begin);
    for (size_t i = 0; i < stages.size(); ++i)
      sum += tableau_.b[i + 1] * load.value(stages[i].time);
    if (!any) velocity_.setZero();
    any = true;
    velocity_.segment(system_.mode_offset(load.body), load.direction.size()) +=
        (rows.integral() - (end - begin) * sum) * load.direction;
  }
  return any ? modal_error(system_, weights_, no_displacement_, velocity_) : 0.0;
}

}  // namespace clatter::dynamics
