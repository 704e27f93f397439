// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The ideal slider-crank at the angle of the crank: that of the clock, or of a crank that turns
// freely.
#include <functional>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// What elements of a cylinder need to know of its crank, over time: theta from firing TDC [rad],
/// the pin's centre along z [m], the rod's angle [rad], each with its first and second derivative.
struct CrankMotion {
  std::function<Motion<double>(double time)> turn, stroke, rod_angle;
};

/// That of the clock.
CrankMotion clock_motion(const SliderCrank& crank);

/// A crank whose angle deviates from that of the clock, as one element sees it: at the start of the
/// step and at the stage under way.
///
/// The deviation and its rate at the start follow from those at the stage by the tableau, and so
/// does its acceleration, for which the rates of the finished stages of the step are kept.
class RealCrank {
 public:
  explicit RealCrank(const SliderCrank& crank)
      : crank_(crank), sign_(crank.spin(0.0) < 0.0 ? -1.0 : 1.0) {}

  /// The trial state at a stage. @param turn rotation about +x from that of the clock [rad].
  /// @param rate of it [rad/s].
  void move(const Stage& stage, double turn, double rate);
  void finish_stage(const Stage& stage);
  void accept_step();

  /// theta at the start of the step or at the stage, whichever `time` is; the acceleration at the
  /// start is that at the end of the step before.
  Motion<double> turn(double time) const;
  Motion<double> stroke(double time) const { return crank_.piston_pin(turn(time)); }
  Motion<double> rod_angle(double time) const { return crank_.rod_angle(turn(time)); }
  const SliderCrank& clock() const { return crank_; }
  double start() const { return start_.time; }  // of the step [s]

  /// The rate and acceleration of the deviation at the end of the last step.
  std::vector<double> save() const { return {accepted_.rate, accepted_.acceleration}; }
  static constexpr size_t kSaved = 2;
  void restore(double rate, double acceleration) { accepted_ = {rate, acceleration}; }

 private:
  struct Rates {
    double rate = 0.0, acceleration = 0.0;  // of the deviation [rad/s], [rad/s2]
  };
  struct Instant {
    double time = 0.0;
    Motion<double> deviation{0.0, 0.0, 0.0};  // in the direction of rotation
  };

  SliderCrank crank_;
  double sign_;
  Instant start_, now_;
  Rates accepted_;
  std::vector<Rates> finished_;  // at the stages of this step, by their index
};

/// The motion that it sees; refers to it.
CrankMotion motion_of(std::shared_ptr<const RealCrank> crank);

}  // namespace clatter::dynamics
