// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal states of elements under the tableau of the step.
#include <array>
#include <span>
#include <vector>

#include "dynamics/law/stage.hpp"

namespace clatter::dynamics {

/// x of a law or element, a vector of fixed size V: x_i = x_n + sum_j weights[j] x'_j + kappa x'_i
/// at stage i (stage.hpp). Stage 0 is the start of a run, or the state that an event left.
template <class V>
class InternalState {
 public:
  explicit InternalState(const V& start) : accepted_(start), value_(start) {}

  /// x_i - kappa x'_i.
  V known(const Stage& stage) const {
    V x = accepted_;
    for (int j = 0; j < stage.index; ++j) x += stage.weights[j] * rates_[j];
    return x;
  }
  /// The trial stage has this x; its rate follows.
  void set_value(const Stage& stage, const V& value) {
    value_ = value;
    rate_ = (value - known(stage)) / stage.kappa;
  }
  /// The trial stage has this rate; x follows, at stage 0 as it is.
  void set_rate(const Stage& stage, const V& rate) {
    rate_ = rate;
    value_ = known(stage);
    if (stage.index > 0)
      value_ += stage.kappa * rate;
    else
      rates_[0] = rate;
  }
  /// After an event: x and its rate are those of before.
  void keep_rate() { rate_ = rates_[0]; }

  const V& value() const { return value_; }
  const V& rate() const { return rate_; }
  bool is_started() const { return started_; }

  void finish_stage(const Stage& stage) {
    rates_[stage.index] = rate_;
    last_stage_ = stage.index;
  }
  void accept_step() {
    accepted_ = value_;
    rates_[0] = rates_[last_stage_];
    started_ = true;
  }

  static constexpr size_t kSaved = 2 * V::SizeAtCompileTime;
  /// x and its rate of the last accepted step, kSaved numbers.
  std::vector<double> save() const {
    std::vector<double> numbers(accepted_.begin(), accepted_.end());
    numbers.insert(numbers.end(), rates_[0].begin(), rates_[0].end());
    return numbers;
  }
  void restore(std::span<const double> numbers) {
    accepted_ = value_ = V(numbers.data());
    rates_[0] = rate_ = V(numbers.data() + V::SizeAtCompileTime);
    started_ = true;
  }

 private:
  V accepted_, value_, rate_ = V::Zero();
  std::array<V, 3> rates_{rate_, rate_, rate_};  // of the stages
  int last_stage_ = 0;
  bool started_ = false;
};

}  // namespace clatter::dynamics
