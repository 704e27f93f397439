// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/uniform_samples.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::dynamics {

SampleBlock SampleBlock::between(int64_t from, int64_t to) const {
  const int64_t low = std::max(first, from), high = std::min(first + count - 1, to);
  SampleBlock part{begin + step * static_cast<double>(from), step, low - from, 0, {}, {}, {}};
  if (high < low) return part;
  part.count = high - low + 1;
  part.eta = eta.middleRows(low - first, part.count);
  part.v = v.middleRows(low - first, part.count);
  part.a = a.middleRows(low - first, part.count);
  return part;
}

int64_t sample_count(double length, double step) {
  return std::max<int64_t>(1, std::llround(length / step)) + 1;
}

double fitted_step(double length, double step) {
  return length / static_cast<double>(sample_count(length, step) - 1);
}

Eigen::Index UniformSamples::block_rows(Eigen::Index modes) {
  // A multiple of four: products with a block then round as those with all rows.
  return std::max<Eigen::Index>(64, 16384 / std::max<Eigen::Index>(modes, 1) / 4 * 4);
}

UniformSamples::UniformSamples(double begin, double end, double step, Eigen::Index modes, Sink sink)
    : sink_(std::move(sink)), total_(sample_count(end - begin, step)) {
  block_.begin = begin;
  block_.step = (end - begin) / static_cast<double>(total_ - 1);
  block_.eta = block_.v = block_.a =
      RowMatrix::Zero(std::min<Eigen::Index>(block_rows(modes), (total_ + 3) / 4 * 4), modes);
}

void UniformSamples::put(const Eigen::VectorXd& eta, const Eigen::VectorXd& v,
                         const Eigen::VectorXd& a) {
  if (block_.count == block_.eta.rows()) {
    sink_(block_);
    block_.first += block_.count;
    block_.count = 0;
  }
  block_.eta.row(block_.count) = eta;
  block_.v.row(block_.count) = v;
  block_.a.row(block_.count) = a;
  ++block_.count;
  ++count_;
}

void UniformSamples::start(const StageState& state) {
  put(state.eta, state.v, state.a);
  v_half_ = state.v;
}

void UniformSamples::take(const StageState& p, const StageState& n, double t) {
  const double h = n.time - p.time, s = std::clamp((t - p.time) / h, 0.0, 1.0);
  const Eigen::VectorXd v = hermite(p.v, p.a, n.v, n.a, h, s);
  if (++halves_ % 2 == 0) {
    // The acceleration is that of the half interval until the next half is complete.
    put(hermite(p.eta, p.v, n.eta, n.v, h, s), v, (v - v_half_) / (0.5 * block_.step));
    return;
  }
  block_.a.row(block_.count - 1) = (v - v_half_) / (count_ == 1 ? 0.5 * block_.step : block_.step);
  v_half_ = v;
}

void UniformSamples::add(const StageState& previous, const StageState& now) {
  // The last sample is at the end itself and must not be lost by rounding.
  const double half = 0.5 * block_.step, slack = 1e-6 * block_.step;
  const auto next = [&] { return block_.begin + half * static_cast<double>(halves_ + 1); };
  while (count_ < total_ && next() <= now.time + slack) take(previous, now, next());
}

void UniformSamples::archive(Archive& archive) {
  archive(count_);
  archive(halves_);
  archive(v_half_);
  archive(block_.first);
  archive(block_.count);
  if (block_.count > block_.eta.rows()) throw InputError("samples: found too many in a block");
  for (RowMatrix* rows : {&block_.eta, &block_.v, &block_.a}) archive.rows(*rows, block_.count);
}

void UniformSamples::finish() {
  if (block_.count > 0) sink_(block_);
  block_.count = 0;
}

}  // namespace clatter::dynamics
