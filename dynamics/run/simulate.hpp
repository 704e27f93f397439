// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Runs a scene from its start (or a checkpoint) to its end, cycle by cycle.
#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "dynamics/film/oil_balance.hpp"
#include "dynamics/run/checkpoint.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/run/run_certificate.hpp"

namespace clatter::dynamics {

/// Result of a run: the recorded cycles (possibly incomplete) and statistics.
struct RunResult {
  std::unique_ptr<Model> model;  // of the recorded cycles; its effects have the cost
  /// The run file with samples, histories, energies and film of the recorded cycles, still without
  /// its final name; write_run() adds the rest.
  std::unique_ptr<H5File> file;
  int64_t samples = 0;    // in the file
  int64_t most_held = 0;  // largest count of recorded numbers in memory
  StepStatistics statistics;
  int cycles = 0;                       // completed; 1 for a scene without an engine
  bool complete = false;                // false: interrupted inside a cycle
  std::string failure;                  // why the integration failed; empty: it did not
  double energy_residue = 0.0;          // of the recorded cycles
  double energy_exchanged = 0.0;        // [J]
  double energy_imbalance = 0.0;        // [J]
  std::optional<film::OilBalance> oil;  // of the contact that misses most of it; none remembered
  std::optional<double> creep;          // longest of the contacts [m]: ForceElement::crept()
  CycleDifference periodicity;          // of the last two cycles
  std::vector<std::string> warnings;  // of the recorded cycles: accuracy, film pressure, components
};

struct RunControl {
  /// The run file, written as `output.part`; each cycle replaces that of the cycle before, up
  /// to the recorded ones. Beside it is a checkpoint, checkpoint_path(output): after each cycle
  /// before them, and without cycles now and then.
  std::filesystem::path output;
  std::optional<Checkpoint> resume_from;    // read from that checkpoint
  const std::atomic<bool>* stop = nullptr;  // set by the caller: stop after a step
  std::string label = "integrating";        // of the progress
  /// Between checkpoints of a run without cycles, at least [s of the clock]; more where writing one
  /// takes long.
  double checkpoint_seconds = 60.0;
};

/// Starts from rest at the ideal position of every body (all deviations zero, so every gap is the
/// clearance) at TDC of gas exchange, with loads growing from zero over `time.ramp`: a consistent
/// state. Integrates `cycles` cycles of 720 deg, or until they repeat to within `settle_to`, or the
/// span of a scene without an engine.
/// When steps fall below the floor the result ends there, with the reason in `failure`. Memory does
/// not grow with the number of steps or samples. FileError when a file cannot be written.
RunResult simulate(const Scene& scene, const LoadedBodies& bodies, const RunControl& control);

}  // namespace clatter::dynamics
