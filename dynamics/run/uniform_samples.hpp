// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Modal motion at uniform times, passed on in blocks.
#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "core/base/matrix.hpp"
#include "dynamics/integrate/stage_state.hpp"
#include "dynamics/law/archive.hpp"

namespace clatter::dynamics {

/// Consecutive samples. The matrices have the rows of a complete block; those after `count` are
/// not set.
struct SampleBlock {
  double begin = 0.0, step = 0.0;  // time of sample 0, and between samples [s]
  int64_t first = 0;               // index of the first row among all samples
  Eigen::Index count = 0;
  RowMatrix eta, v, a;  // rows x modes

  double time(Eigen::Index row) const { return begin + step * static_cast<double>(first + row); }
  /// Those of samples `from` to `to`, the last one included, `from` being the first of all.
  SampleBlock between(int64_t from, int64_t to) const;
};

/// Number of samples of a span, both ends included: its length over `step`, rounded, plus 1.
int64_t sample_count(double length, double step);

/// The step nearest to `step` of which `length` is an integer number [s].
double fitted_step(double length, double step);

/// Modal motion at uniform times begin + i (end - begin) / n, i = 0..n.
///
/// Between accepted states q and v are cubic Hermite interpolants (of q, v and of v, a). a is the
/// mean over one sampling interval around its instant, from v half an interval before and after: an
/// impact shorter than the interval keeps its momentum and does not fold into lower frequencies.
/// The first and last sample use the half interval available.
class UniformSamples {
 public:
  using Sink = std::function<void(const SampleBlock&)>;
  /// `sink` takes each block as soon as its accelerations are complete; only one block is held.
  UniformSamples(double begin, double end, double step, Eigen::Index modes, Sink sink);
  /// Takes the sample at `begin`.
  void start(const StageState& state);
  /// Takes the samples in (previous, now].
  void add(const StageState& previous, const StageState& now);
  /// Passes on what is left; the samples end here.
  void finish();
  /// What is held, for the same span; the sink has the blocks before.
  void archive(Archive& archive);

  int64_t count() const { return count_; }  // samples taken so far
  /// Numbers in memory.
  int64_t held() const { return 3 * block_.eta.size(); }
  /// Rows of a block for so many modes: 128 KiB each of eta, v and a, at least 64 rows.
  static Eigen::Index block_rows(Eigen::Index modes);

 private:
  void put(const Eigen::VectorXd& eta, const Eigen::VectorXd& v, const Eigen::VectorXd& a);
  void take(const StageState& p, const StageState& n, double t);
  SampleBlock block_;
  Sink sink_;
  int64_t total_;
  int64_t count_ = 0;
  int64_t halves_ = 0;      // half intervals passed since begin
  Eigen::VectorXd v_half_;  // v at the last half
};

}  // namespace clatter::dynamics
