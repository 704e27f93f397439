// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stroke of the piston as the integrator's tableau has it.
#include <array>
#include <functional>
#include <utility>

#include "dynamics/element/element.hpp"

namespace clatter::film {

/// Stroke position and velocity of the piston's reference point (pin centre) along engine z.
struct StrokeState {
  double position = 0.0;  // z_B [m]
  double velocity = 0.0;  // dz_B/dt [m/s]
};

/// z_B within a step, integrated by the tableau as y is, from its exact value at the start of the
/// step. The pressure of a full film follows from dh/dt; the difference of two exact gaps would be
/// the rate at another instant, and with SDIRK2 the pressure only of first order.
class StrokeSteps {
 public:
  explicit StrokeSteps(std::function<StrokeState(double time)> law) : law_(std::move(law)) {}

  /// At a stage of the step that began at stage.time minus all of its weights.
  StrokeState at(const dynamics::Stage& stage) const;
  /// From the start of the step to this stage [m], as the film's speed has it.
  double travel(const dynamics::Stage& stage) const;
  /// At an instant, exact.
  StrokeState exact(double time) const { return law_(time); }
  void finish_stage(const dynamics::Stage& stage);

 private:
  std::function<StrokeState(double time)> law_;
  std::array<double, 4> rates_{};  // z_B' at the finished stages of this step [m/s]
};

}  // namespace clatter::film
