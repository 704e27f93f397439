// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Factors of shapes that change in the cycle.
#include <array>
#include <functional>
#include <vector>

#include "dynamics/element/crank_angle.hpp"
#include "dynamics/film/gap.hpp"

namespace clatter::film {

/// A factor and its rate.
struct ScaleState {
  double value = 0.0;  // [1]
  double rate = 0.0;   // [1/s]
};

/// A shape of a rigid surface times a factor over the time of the crank's clock, such as a gas
/// deformation.
struct ScaledShape {
  LinerShape shape;
  std::function<ScaleState(double time)> scale;
};

/// The factors of some shapes. They follow the tableau within a step, from their exact values at
/// its start, as the stroke does: the film's pressure follows from the gap's rate, and the
/// difference of two exact gaps would be the rate at another instant.
class CycleScales {
 public:
  void add(std::function<ScaleState(double time)> scale);
  bool empty() const { return laws_.empty(); }
  const std::vector<ScaleState>& at(const dynamics::Stage& stage, const dynamics::CrankLead& lead);
  /// At an instant, exact; `lead` then.
  std::vector<ScaleState> exact(double time, const dynamics::Motion<double>& lead) const;
  void finish_stage(const dynamics::Stage& stage);

 private:
  ScaleState law_at(size_t law, double time, const dynamics::Motion<double>& lead) const;
  std::vector<std::function<ScaleState(double time)>> laws_;
  std::vector<ScaleState> now_;
  std::vector<std::array<double, 4>> rates_;  // at the finished stages of this step [1/s]
};

/// What the scaled shapes add to the gap of one pad.
class ScaledGap {
 public:
  explicit ScaledGap(const PadGrid& pad) : pad_(pad) {}
  /// Factors are counted in the order in which shapes are added.
  void add_bore(const LinerShape& shape) { bore_.emplace_back(shape, pad_); }
  void add_skirt(const LinerShape& shape);
  /// Adds to the gap and its slope along the stroke, n; the pad's z = 0 is at `height` [m].
  void add(double height, const std::vector<ScaleState>& scales, Eigen::ArrayXd& gap,
           Eigen::ArrayXd& slope);
  /// dh/dt by the factors [m/s] and its slope along the stroke [1/s] at the last add(), n.
  const Eigen::ArrayXd& rate() const { return rate_; }
  const Eigen::ArrayXd& rate_slope() const { return rate_slope_; }

 private:
  PadGrid pad_;
  std::vector<LinerShapeMap> bore_;
  std::vector<Eigen::ArrayXd> skirt_;  // at the cells [m]
  Eigen::ArrayXd value_, value_slope_, rate_, rate_slope_;
};

}  // namespace clatter::film
