// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A table over an angle that a step passes.
#include <algorithm>
#include <limits>
#include <utility>

#include "dynamics/element/table_force.hpp"
#include "dynamics/integrate/stage_state.hpp"

namespace clatter::dynamics {

/// The force of a table over an angle as a function of the time since the end of a step at which
/// the angle is smaller: the angle is the cubic of both ends, or, where that is not monotone, the
/// line between them.
class TablePass {
 public:
  /// @param begin, end time [s] and angle at both ends of the step.
  TablePass(const TableForce& table, std::pair<double, TurningAngle> begin,
            std::pair<double, TurningAngle> end)
      : table_(table),
        from_(begin.first),
        step_(end.first - begin.first),
        falls_(end.second.angle < begin.second.angle),
        low_(begin.second),
        high_(end.second) {
    if (falls_) {
      std::swap(low_, high_);
      low_.rate = -low_.rate;
      high_.rate = -high_.rate;
    }
    const double mean = (high_.angle - low_.angle) / step_;
    const auto steady = [mean](double rate) { return rate > 0.0 && rate < 3.0 * mean; };
    if (!steady(low_.rate) || !steady(high_.rate)) low_.rate = high_.rate = mean;
  }

  double length() const { return step_; }
  double value(double since) const {
    const double rate = this->rate(since);
    return table_.by_table(falls_ ? from_ + step_ - since : from_ + since,
                           {angle(since), falls_ ? -rate : rate});
  }
  /// When the angle is next at a row; infinity after the last one within the step.
  double next_row(double since) const {
    double row = angle(since);
    do {
      row = table_.next_row(row);
      if (row >= high_.angle) return std::numeric_limits<double>::infinity();
    } while (time_of(row) <= since);
    return time_of(row);
  }

 private:
  double angle(double since) const {
    return hermite(low_.angle, low_.rate, high_.angle, high_.rate, step_, since / step_);
  }
  double rate(double since) const {
    return hermite_rate(low_.angle, low_.rate, high_.angle, high_.rate, step_, since / step_);
  }
  /// By Newton's method from that of a steady rotation; monotone cubics of a step are close to it.
  double time_of(double row) const {
    constexpr int kIterations = 4;
    double since = step_ * (row - low_.angle) / (high_.angle - low_.angle);
    for (int i = 0; i < kIterations; ++i) {
      const double speed = rate(since);
      if (!(speed > 0.0)) break;
      since = std::clamp(since - (angle(since) - row) / speed, 0.0, step_);
    }
    return since;
  }

  const TableForce& table_;
  double from_, step_;
  bool falls_;
  TurningAngle low_, high_;  // rates toward the larger angle
};

}  // namespace clatter::dynamics
