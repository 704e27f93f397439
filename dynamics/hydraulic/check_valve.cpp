// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/check_valve.hpp"

#include <algorithm>
#include <numbers>

namespace clatter::dynamics {

using Ball = CheckValveSpec::Ball;

double CheckValveSpec::ball_mass() const {
  return std::numbers::pi / 6.0 * ball_density * ball_diameter * ball_diameter * ball_diameter;
}

double CheckValveSpec::seat_area() const {
  return 0.25 * std::numbers::pi * seat_diameter * seat_diameter;
}

double CheckValve::lift(double pressure, double own) const {
  switch (spec_.ball) {
    case Ball::kQuasiStatic:
      return spec_.lift *
             smooth_step((pressure - spec_.opening) / (spec_.full_opening - spec_.opening)).value;
    case Ball::kMoving:
      return std::max(own, 0.0);
    case Ball::kStuckOpen:
      return spec_.lift;
    case Ball::kStuckShut:
      break;
  }
  return 0.0;
}

VolumeFlow CheckValve::flow(double pressure, double own_lift) const {
  const double open = lift(pressure, own_lift);
  if (open <= 0.0) return {};
  const double width = spec_.discharge * std::numbers::pi * spec_.seat_diameter;
  const VolumeFlow per_lift = orifice_flow(width, density_, spec_.laminar, pressure);
  VolumeFlow flow{open * per_lift.value, open * per_lift.by_pressure, 0.0};
  if (spec_.ball == Ball::kMoving) flow.by_lift = per_lift.value;
  if (spec_.ball == Ball::kQuasiStatic) {
    const double range = spec_.full_opening - spec_.opening;
    flow.by_pressure +=
        per_lift.value * spec_.lift * smooth_step((pressure - spec_.opening) / range).slope / range;
  }
  return flow;
}

BallForce CheckValve::ball(double lift, double speed) const {
  BallForce force;
  force.value = -spec_.spring_force - spec_.spring_rate * lift - spec_.drag * speed;
  force.by_lift = -spec_.spring_rate;
  force.by_speed = -spec_.drag;
  force.stored = spec_.spring_force * lift + 0.5 * spec_.spring_rate * lift * lift;
  force.lost = spec_.drag * speed * speed;
  // Depth and its rate as seen from the seat (side 1) or the stop (side -1).
  const double side = lift < 0.0 ? 1.0 : -1.0;
  const double depth = lift < 0.0 ? -lift : lift - spec_.lift;
  if (depth <= 0.0) return force;
  const double k = spec_.contact_stiffness, rate = -side * speed;
  const double factor = std::max(0.0, 1.0 + spec_.contact_damping * rate);
  force.value += side * k * depth * factor;
  force.by_lift -= k * factor;
  if (factor > 0.0) force.by_speed -= k * depth * spec_.contact_damping;
  force.stored += 0.5 * k * depth * depth;
  force.lost += k * depth * (factor - 1.0) * rate;
  return force;
}

}  // namespace clatter::dynamics
