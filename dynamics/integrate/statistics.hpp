// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Counts and cost of the time integration.
#include <algorithm>
#include <limits>
#include <map>
#include <string>

namespace clatter::dynamics {

/// Refusals of one kind (StepRefused).
struct RefusalCount {
  long long count = 0;
  std::string last;  // detail of the last one
};

/// Counts since the start of a run.
struct StepStatistics {
  long long accepted = 0;
  long long rejected_error = 0;    // the error test failed
  long long rejected_newton = 0;   // the stage equations did not converge
  long long rejected_refused = 0;  // an element refused a trial state
  long long stages = 0;            // implicit stages that were solved
  long long evaluations = 0;       // evaluations of all elements
  long long factorizations = 0;    // of the Newton matrix
  long long operators = 0;         // S = P H P^T formed
  long long events = 0;            // state events
  double smallest_step = std::numeric_limits<double>::infinity();  // accepted [s]
  double largest_step = 0.0;                                       // accepted [s]
  double element_seconds = 0.0;
  double factor_seconds = 0.0;
  double operator_seconds = 0.0;
  double total_seconds = 0.0;
  std::map<std::string, RefusalCount> refusals;  // by kind

  StepStatistics& operator+=(const StepStatistics& other) {
    accepted += other.accepted;
    rejected_error += other.rejected_error;
    rejected_newton += other.rejected_newton;
    rejected_refused += other.rejected_refused;
    stages += other.stages;
    evaluations += other.evaluations;
    factorizations += other.factorizations;
    operators += other.operators;
    events += other.events;
    smallest_step = std::min(smallest_step, other.smallest_step);
    largest_step = std::max(largest_step, other.largest_step);
    element_seconds += other.element_seconds;
    factor_seconds += other.factor_seconds;
    operator_seconds += other.operator_seconds;
    total_seconds += other.total_seconds;
    for (const auto& [kind, more] : other.refusals) {
      RefusalCount& all = refusals[kind];
      all.count += more.count;
      all.last = more.last;
    }
    return *this;
  }
};

}  // namespace clatter::dynamics
