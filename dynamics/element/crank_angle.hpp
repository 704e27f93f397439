// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where a crank is: by its clock, or by a coordinate besides.
#include <Eigen/Core>
#include <vector>

#include "dynamics/element/table_force.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/law/stage.hpp"

namespace clatter::dynamics {

/// By how much time a crank is ahead of its clock, at one stage.
struct CrankLead {
  Motion<double> now{0.0, 0.0, 0.0};      // l [s] and its derivatives in time at the stage
  Motion<double> by_turn{0.0, 0.0, 0.0};  // of `now` by the crank's coordinate, at fixed stage
  Motion<double> begin{0.0, 0.0, 0.0};    // l and l' at the begin of the step
};

/// The angle of a crank: that of its clock or, of a free one, apart from it by a coordinate of the
/// system, its rotation a about +x.
///
/// With theta(t) of the clock, a free crank is where the clock is at the time t + l:
///
///   theta(t + l) = theta(t) + d,   d = a in the direction of rotation
///
/// so that what is given over the time of the clock (a stroke, a pressure) holds at t + l, and
/// rates are times 1 + l'. Elements that need it have a as their last coordinate; no force of
/// theirs acts on it.
class CrankAngle {
 public:
  /// Of no crank, and of one that turns as its clock: l = 0.
  CrankAngle() = default;
  /// @param clock of the crank. @param turn y index of a.
  CrankAngle(const SliderCrank& clock, int turn)
      : CrankAngle(clock.clock(), clock.rotation(), turn, clock.firing()) {}
  /// @param firing angle of the crankshaft at which theta is 0 [rad].
  CrankAngle(CrankClock clock, Rotation rotation, int turn, double firing = 0.0);

  bool is_free() const { return turn_ >= 0; }
  /// Adds a to the coordinates of an element, if it is free.
  void join(std::vector<int>& coordinates) const;
  /// d/a: 1 forward, -1 backward.
  double sign() const { return sign_; }
  /// theta of a free crank at a [rad], a' [rad/s].
  TurningAngle at(double time, double turn, double rate) const;
  /// theta of a free crank by all coordinates of the system [rad].
  double of(double time, const Eigen::VectorXd& all) const {
    return at(time, all(turn_), 0.0).angle;
  }
  /// `y`, `v` of an element. l'' is 0 where the stage does not know v_known.
  CrankLead lead(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;

 private:
  /// l of the crank that is `apart` from its clock: d and its derivatives.
  Motion<double> lead_of(double time, const Motion<double>& apart) const;

  CrankClock clock_;
  double sign_ = 1.0, firing_ = 0.0;
  int turn_ = -1;
};

/// A motion that is given over the time of the clock, at t + l.
template <class T>
Motion<T> led(const Motion<T>& given, const Motion<double>& lead) {
  const double rate = 1.0 + lead.velocity;
  return {given.position, rate * given.velocity,
          rate * rate * given.acceleration + lead.acceleration * given.velocity};
}

/// Its derivative by the crank's coordinate at fixed stage. The third derivative of what is given
/// is left out: (w kappa)^2 of the acceleration's at the speed w.
template <class T>
Motion<T> led_by_turn(const Motion<T>& given, const CrankLead& lead) {
  const Motion<double>& by = lead.by_turn;
  const double rate = 1.0 + lead.now.velocity;
  return {
      by.position * given.velocity,
      by.velocity * given.velocity + rate * by.position * given.acceleration,
      by.acceleration * given.velocity +
          (2.0 * rate * by.velocity + lead.now.acceleration * by.position) * given.acceleration};
}

}  // namespace clatter::dynamics
