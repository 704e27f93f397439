// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Results of one cycle (or of an entire run): uniform samples, histories, energies, film fields.
#include <map>
#include <string>
#include <vector>

#include "dynamics/run/energy.hpp"
#include "dynamics/run/model.hpp"

namespace clatter::dynamics {

/// Modal motion at uniform times begin + i (end - begin) / n, i = 0..n.
///
/// Between accepted states q and v are cubic Hermite interpolants (of q, v and of v, a). a is the
/// mean over one sampling interval around its instant, from v half an interval before and after: an
/// impact shorter than the interval keeps its momentum and does not fold into lower frequencies.
/// The first and last sample use the half interval available.
class UniformSamples {
 public:
  UniformSamples(double begin, double end, double step, int modes);
  /// Takes the sample at `begin`.
  void start(const StageState& state);
  /// Takes the samples in (previous, now].
  void add(const StageState& previous, const StageState& now);

  int count() const { return count_; }  // samples taken so far
  double time(int i) const;
  double step() const { return step_; }
  /// count x modes; rows beyond count() are not set.
  const RowMatrix& eta() const { return eta_; }
  const RowMatrix& v() const { return v_; }
  const RowMatrix& a() const { return a_; }

 private:
  void take(const StageState& p, const StageState& n, double t);
  double begin_, step_;
  int count_ = 0;
  int halves_ = 0;          // half intervals passed since begin
  Eigen::VectorXd v_half_;  // v at the last half
  RowMatrix eta_, v_, a_;
};

/// Columns of numbers that grow row by row.
struct Columns {
  std::vector<std::string> names, units;
  std::vector<std::vector<double>> values;  // one per column
};

/// Film fields of some instants.
struct FilmFrames {
  std::vector<double> time;
  std::vector<std::vector<film::PadSnapshot>> pads;
};

/// Records one span of a run.
class Recorder {
 public:
  /// `film_every`: time between film fields [s], 0: none.
  Recorder(const Model& model, double begin, double end, double step, double film_every);
  /// The state that the span starts from: a sample, no history (elements were not evaluated there).
  void start(const StageState& state) { samples_.start(state); }
  /// After each accepted step.
  void record(const Model& model, const StageState& previous, const StageState& now,
              const EnergyBalance& energy);

  const UniformSamples& samples() const { return samples_; }
  const std::vector<double>& time() const { return time_; }  // of the histories: accepted states
  const Columns& history() const { return history_; }
  const Columns& energy() const { return energy_; }
  const FilmFrames& film() const { return film_; }

 private:
  static void append(Columns& columns, const History& row);
  UniformSamples samples_;
  std::vector<double> time_;
  Columns history_, energy_;
  FilmFrames film_;
  double film_every_, next_film_;
};

}  // namespace clatter::dynamics
