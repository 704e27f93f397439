// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stroke of the piston as the integrator's tableau has it.
#include <array>
#include <functional>
#include <utility>

#include "dynamics/element/crank_angle.hpp"

namespace clatter::film {

/// Stroke of the piston's reference point (pin centre) along engine z.
struct StrokeState {
  double position = 0.0;      // z_B [m]
  double velocity = 0.0;      // dz_B/dt [m/s]
  double acceleration = 0.0;  // of a free crank, for tangents [m/s2]
};

/// Both strokes of one instant: they differ where the crank is free.
struct PinStroke {
  StrokeState clock;  // by the clock: the pin's coordinate counts from it
  StrokeState ideal;  // of the ideal mechanism at the angle of the crank, without acceleration
};

/// z_B within a step, integrated by the tableau as y is, from its exact value at the start of the
/// step. The pressure of a full film follows from dh/dt; the difference of two exact gaps would be
/// the rate at another instant, and with SDIRK2 the pressure only of first order.
class StrokeSteps {
 public:
  /// @param law of the stroke over the time of the clock.
  StrokeSteps(std::function<StrokeState(double time)> law, dynamics::CrankAngle crank)
      : law_(std::move(law)), crank_(std::move(crank)) {}

  /// Finds the following at a stage, from the state of the element.
  void find(const dynamics::Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v);
  const PinStroke& now() const { return now_; }
  const dynamics::CrankLead& lead() const { return lead_; }
  /// Of the ideal pin's velocity by the coordinate of a free crank [m/s].
  double slide_by_turn() const { return slide_by_turn_; }
  /// Of the ideal pin since the start of the step [m], as the film's speed has it.
  double travel(const dynamics::Stage& stage) const;
  void finish_stage(const dynamics::Stage& stage);

  /// At an instant, exact; `lead` then.
  PinStroke exact(double time, const dynamics::Motion<double>& lead) const;

 private:
  std::function<StrokeState(double time)> law_;
  dynamics::CrankAngle crank_;
  PinStroke now_;
  dynamics::CrankLead lead_;
  double slide_by_turn_ = 0.0;
  std::array<double, 4> clock_rates_{}, ideal_rates_{};  // z_B' at the finished stages of this step
};

}  // namespace clatter::film
