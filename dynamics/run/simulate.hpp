// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Runs a scene from its start (or a checkpoint) to its end, cycle by cycle.
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "dynamics/run/checkpoint.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/run/recorder.hpp"
#include "dynamics/run/run_certificate.hpp"

namespace clatter::dynamics {

/// Result of a run: the last cycle (possibly incomplete) and statistics.
struct RunResult {
  std::unique_ptr<Model> model;  // of the last cycle; its effects have the cost
  std::unique_ptr<Recorder> recorder;
  StepStatistics statistics;
  int cycles = 0;                     // completed; 1 for a scene without an engine
  bool complete = false;              // false: interrupted inside a cycle
  std::string failure;                // why the integration failed; empty: it did not
  double energy_residue = 0.0;        // of the reported cycle
  double energy_exchanged = 0.0;      // [J]
  CycleDifference periodicity;        // of the reported cycle
  std::vector<std::string> warnings;  // of accuracy_warnings(), in the reported cycle
};

struct RunControl {
  std::optional<Checkpoint> resume_from;
  const std::atomic<bool>* stop = nullptr;            // set by the caller: stop after a step
  std::function<void(const Checkpoint&)> checkpoint;  // after each cycle but the last
  double film_every = 0.0;                            // [s]
  std::string label = "integrating";                  // of the progress
};

/// Starts from rest at the ideal position of every body (all deviations zero, so every gap is the
/// clearance) at TDC of gas exchange, with loads growing from zero over `time.ramp`: a consistent
/// state. Integrates `cycles` cycles of 720 deg, or the span of a scene without an engine.
/// When steps fall below the floor the result ends there, with the reason in `failure`.
RunResult simulate(const Scene& scene, const LoadedBodies& bodies, const RunControl& control);

}  // namespace clatter::dynamics
