// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Ball check valve between the supply and the chamber.
#include "dynamics/hydraulic/flow_laws.hpp"

namespace clatter::dynamics {

struct CheckValveSpec {
  enum class Ball : char { kQuasiStatic, kMoving, kStuckShut, kStuckOpen };
  Ball ball = Ball::kQuasiStatic;
  double seat_diameter = 3e-3;  // [m]
  double lift = 0.42e-3;        // up to the stop [m]
  double discharge = 0.7;       // coefficient of the opening pi seat_diameter lift
  double laminar = 100.0;       // below about this pressure difference the flow is laminar [Pa]
  /// A quasi-static ball begins to open, and is open, at these pressure differences [Pa].
  double opening = 0.0, full_opening = 2e3;
  /// A moving ball.
  double ball_diameter = 4e-3, ball_density = 7800.0;  // [m], [kg/m3]
  double spring_force = 0.0, spring_rate = 0.0;        // on the seat [N], [N/m]
  double contact_stiffness = 1e7;                      // of seat and stop [N/m]
  double contact_damping = 0.5;                        // chi of k d (1 + chi d') [s/m]
  double drag = 0.02;                                  // of the oil round the ball [N s/m]

  double ball_mass() const;  // [kg]
  double seat_area() const;  // [m2]
};

/// Force on the ball in the opening direction, with derivatives by its lift and its speed; the
/// pressure has its share apart (seat_area times difference).
struct BallForce {
  double value = 0.0, by_lift = 0.0, by_speed = 0.0;
  double stored = 0.0, lost = 0.0;  // [J], [W]
};

/// Flow through the opening pi seat_diameter lift. A quasi-static ball follows the pressure
/// difference as a smooth monotone function; a moving one has a lift of its own.
class CheckValve {
 public:
  /// @param density of the oil in the orifice's law [kg/m3].
  CheckValve(const CheckValveSpec& spec, double density) : spec_(spec), density_(density) {}
  bool has_moving_ball() const { return spec_.ball == CheckValveSpec::Ball::kMoving; }
  /// The ball's lift at a pressure difference (supply over chamber); `own` is that of a moving one.
  double lift(double pressure, double own) const;
  /// From the supply to the chamber. A moving ball lets oil back until it is on its seat.
  VolumeFlow flow(double pressure, double own_lift) const;
  /// Spring, seat, stop and drag on a moving ball; seat and stop by Hunt and Crossley (1975), which
  /// never pull.
  BallForce ball(double lift, double speed) const;
  const CheckValveSpec& spec() const { return spec_; }

 private:
  CheckValveSpec spec_;
  double density_;
};

}  // namespace clatter::dynamics
