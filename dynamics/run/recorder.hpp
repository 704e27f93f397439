// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Results of the recorded cycles (or of an entire run), which go to the run file block by block.
#include <vector>

#include "dynamics/law/history.hpp"
#include "dynamics/run/column_stream.hpp"
#include "dynamics/run/component_fields.hpp"
#include "dynamics/run/energy.hpp"
#include "dynamics/run/film_stream.hpp"
#include "dynamics/run/model.hpp"
#include "dynamics/run/uniform_samples.hpp"

namespace clatter::dynamics {

/// What is recorded of a span.
struct RecordedSpan {
  double begin = 0.0, end = 0.0;  // [s]
  double cycle = 0.0;             // its length, or that of the entire span [s]
  double output_step = 0.0;       // between samples, as requested [s]
  double film_every = 0.0;        // between film fields [s], 0: none
};

/// Records one span of a run into the groups `history`, `energy` and `film` of a run file, and
/// those of the components' fields; the samples go to a sink. What is held in memory does not grow
/// with the span.
class Recorder {
 public:
  /// `model` and `file` outlive the recorder; `sink` takes the blocks of samples.
  Recorder(const Model& model, const RecordedSpan& span, H5File& file, UniformSamples::Sink sink);
  /// The state that the span starts from: a sample, no history (elements were not evaluated there).
  void start(const StageState& state) { samples_.start(state); }
  /// After each accepted step.
  void record(const Integrator& method, const EnergyBalance& energy);
  /// Writes what is left, also of a span that ends early.
  void finish();
  /// What a checkpoint within the span keeps besides what the file has: all but a block of samples
  /// is written before.
  void archive(Archive& archive);

  /// The scalars of the last accepted state.
  const History& last() const { return last_; }
  int64_t samples() const { return samples_.count(); }
  /// Numbers in memory, all together.
  int64_t held() const;

 private:
  void add_clock(double time);
  void record_energy(const EnergyBalance& energy);
  void write_held();
  const Model& model_;
  UniformSamples samples_;
  History last_;
  ColumnStream history_, energy_, film_clock_;
  std::vector<FilmStream> films_;  // of the contacts
  std::vector<ComponentFields> fields_;
  std::vector<double> row_;
  double film_every_, next_film_;
};

}  // namespace clatter::dynamics
