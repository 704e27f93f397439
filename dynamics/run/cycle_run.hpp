// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One cycle of a run, from a checkpoint to the next.
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/h5_file.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/run/checkpoint.hpp"
#include "dynamics/run/film_pressure.hpp"
#include "dynamics/run/force_record.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/run/periodicity.hpp"
#include "dynamics/run/recorder.hpp"
#include "dynamics/run/simulate.hpp"

namespace clatter::dynamics {

/// Start and end of a cycle [s].
struct Span {
  double begin, end;
};

/// One cycle with a newly built model and a new run file; the whole of a scene without an engine.
class CycleRun {
 public:
  /// From the start of the scene where `from.cycle` is 0, else from that checkpoint, which is
  /// beside `output`. All arguments outlive the cycle. InputError for a damaged checkpoint.
  CycleRun(const Scene& scene, const LoadedBodies& bodies, const Checkpoint& from,
           const std::filesystem::path& output);
  CycleRun(const CycleRun&) = delete;
  CycleRun& operator=(const CycleRun&) = delete;

  /// False when it was stopped before the end.
  bool run(const std::function<void(double)>& progress, const std::atomic<bool>* stop);
  /// Writes what is left, at the end of the cycle or earlier.
  void finish();

  /// The end of the cycle, from which the next one starts. A scene that settles is moved to where
  /// its slow motion repeats, and its clock is turned back.
  Checkpoint next() const;
  /// Writes the checkpoint of a cycle that another one follows.
  void commit(const Checkpoint& point, const std::string& mark);
  /// The end of the run goes to the run file.
  void write_end();

  Span span() const { return span_; }
  const StepStatistics& statistics() const { return method_->statistics(); }
  /// The largest difference of a body's velocities from those of the cycle before; infinite in the
  /// first cycle.
  double change() const;
  /// Adds what this cycle reports, except of its end and its model.
  void report(RunResult& result) const;
  const Model& model() const { return *model_; }
  std::unique_ptr<Model> model_out() { return std::move(model_); }
  std::unique_ptr<H5File> file_out() { return std::move(file_); }

 private:
  void start();
  void restore(const Checkpoint& from);
  void pass_on(const SampleBlock& block);
  void settle(Checkpoint& point) const;

  const Scene& scene_;
  const LoadedBodies& bodies_;
  int cycle_;
  Span span_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<H5File> file_;
  EnergyBalance energy_;
  ForceRecords forces_;
  std::unique_ptr<Integrator> method_;
  StageState begin_;
  Recorder recorder_;
  std::optional<CycleComparison> before_;
  std::optional<CheckpointFile> next_;
  FilmPressureWatch pressure_;
  int64_t most_held_ = 0;
};

/// Cycles of a scene at most, 1 without an engine.
int most_cycles(const Scene& scene);

}  // namespace clatter::dynamics
