// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A span of a run: one cycle, or the recorded ones, or a scene without cycles.
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

/// Start and end of consecutive cycles [s].
struct Span {
  double begin, end;
  int cycles = 1;
  double cycle = end - begin;  // the length of one [s]

  /// The end of a cycle, of which and of those after it there are `left`.
  double end_of_cycle(int left) const { return left > 1 ? end - cycle * left + cycle : end; }
};

/// A cycle, or all recorded ones, with a newly built model and a new run file; the whole of a scene
/// without an engine. A recorded cycle begins as from a checkpoint, so the motion does not depend
/// on how many are recorded.
class CycleRun {
 public:
  /// From the start of the scene where `from` has no state, else from that checkpoint, which is
  /// beside `output`. All arguments outlive this. InputError for a damaged checkpoint.
  CycleRun(const Scene& scene, const LoadedBodies& bodies, const Checkpoint& from,
           const std::filesystem::path& output);
  CycleRun(const CycleRun&) = delete;
  CycleRun& operator=(const CycleRun&) = delete;

  /// False when it was stopped before the end. `at_point` is called where there may be a checkpoint
  /// within the span.
  bool run(const std::function<void(double)>& progress, const std::function<void()>& at_point,
           const std::atomic<bool>* stop);
  /// Writes what is left, at the end of the span or earlier.
  void finish();

  /// The end of the span, from which the next one starts. A scene that settles is moved to where
  /// its slow motion repeats, and its clock is turned back.
  Checkpoint next() const;
  /// Within a span, where run() calls `at_point`.
  Checkpoint within();
  /// Writes the checkpoint next(), or within().
  void commit(const Checkpoint& point, const std::string& mark);
  /// The end of the run goes to the run file.
  void write_end();

  Span span() const { return span_; }
  /// Cycles of the run that are complete, with those before.
  int completed() const { return completed_; }
  const StepStatistics& statistics() const { return method_->statistics(); }
  /// The largest difference of a body's velocities from those of the cycle before; infinite in the
  /// first cycle.
  double change() const;
  /// Adds what this span reports, except of its end and its model.
  void report(RunResult& result) const;
  const Model& model() const { return *model_; }
  std::unique_ptr<Model> model_out() { return std::move(model_); }
  std::unique_ptr<H5File> file_out() { return std::move(file_); }

 private:
  void start();
  void restore(const Checkpoint& from);
  void compare_with(H5File before);
  void take_up(const Checkpoint& from, const H5File& file);
  Checkpoint here() const;
  void archive(Archive& archive);
  void begin_again();
  void pass_on(const SampleBlock& block);
  void settle(Checkpoint& point) const;

  const Scene& scene_;
  std::filesystem::path point_;  // of the checkpoint
  const LoadedBodies& bodies_;
  int completed_;
  Span span_;
  double output_step_;  // [s]
  std::unique_ptr<Model> model_;
  std::unique_ptr<H5File> file_;
  EnergyBalance energy_;
  ForceRecords forces_;
  std::unique_ptr<Integrator> method_;
  StageState begin_;
  Recorder recorder_;
  std::optional<CycleComparison> before_;
  /// Samples of the cycle that the one after this span, or the last one of it, is compared with.
  std::optional<CheckpointFile> next_;
  FilmPressureWatch pressure_;
  int64_t most_held_ = 0;
};

/// Cycles of a scene at most, 1 without an engine.
int most_cycles(const Scene& scene);

}  // namespace clatter::dynamics
