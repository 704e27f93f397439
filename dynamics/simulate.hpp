#pragma once
// Runs a scene from its start (or a checkpoint) to its end, cycle by cycle.
#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "dynamics/checkpoint.hpp"
#include "dynamics/model.hpp"
#include "dynamics/recorder.hpp"

namespace clatter::dynamics {

/// What a run gives: the last cycle (or as far as it came) and what was measured on the way.
struct RunResult {
  std::unique_ptr<Model> model;  // of the last cycle; its effects carry the cost
  std::unique_ptr<Recorder> recorder;
  StepStatistics statistics;
  int cycles = 0;                 // completed; 1 for a scene without an engine
  bool complete = false;          // false: interrupted inside a cycle
  std::string failure;            // why the integration gave up; empty: it did not
  double energy_residue = 0.0;    // of the reported cycle
  double energy_exchanged = 0.0;  // [J]
  std::map<std::string, double> periodicity;
  std::vector<std::string> doubts;  // of accuracy_doubts(), in the reported cycle
};

struct RunControl {
  std::optional<Checkpoint> resume_from;
  const std::atomic<bool>* stop = nullptr;            // set from outside: end at a step
  std::function<void(const Checkpoint&)> checkpoint;  // after each cycle but the last
  double film_every = 0.0;                            // [s]
};

/// Starts from rest at the ideal place of every body (all deviations zero, so every gap is the
/// clearance) at TDC of gas exchange, loads growing from nothing over `time.ramp`: a consistent
/// state. Integrates `cycles` cycles of 720 deg, or the span of a scene without an engine.
/// When steps fall below the floor the result ends there and says why in `failure`.
RunResult simulate(const Scene& scene, const LoadedBodies& bodies, const RunControl& control);

}  // namespace clatter::dynamics
