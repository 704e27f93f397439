// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/crank.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

SliderCrank::SliderCrank(double radius, double rod_length, double pin_offset, CrankClock clock,
                         double firing, Rotation rotation)
    : radius_(radius),
      rod_length_(rod_length),
      pin_offset_(pin_offset),
      firing_(firing),
      sign_(rotation == Rotation::kForward ? 1.0 : -1.0),
      clock_(std::move(clock)) {
  if (!(radius > 0.0) || !(rod_length > radius + std::abs(pin_offset))) {
    throw InputError(
        fmt::format("slider-crank: crank radius {} m, rod {} m, pin offset {} m: expected rod > "
                    "radius + offset",
                    radius, rod_length, pin_offset));
  }
}

Motion<double> SliderCrank::turn(double time) const {
  Motion<double> turn = clock_.turn(time);
  turn.position -= firing_;
  return turn;
}

Motion<Eigen::Vector2d> SliderCrank::crank_pin(double time) const { return crank_pin(turn(time)); }

Motion<double> SliderCrank::rod_angle(double time) const { return rod_angle(turn(time)); }

Motion<double> SliderCrank::piston_pin(double time) const { return piston_pin(turn(time)); }

Motion<Eigen::Vector2d> SliderCrank::rod_point(double time, double distance) const {
  return rod_point(turn(time), distance);
}

Motion<Eigen::Vector2d> SliderCrank::crank_pin(const Motion<double>& theta) const {
  const double s = std::sin(theta.position), c = std::cos(theta.position);
  const double v = radius_ * theta.velocity, inward = v * theta.velocity;
  const double along = radius_ * theta.acceleration;
  return {{-sign_ * radius_ * s, radius_ * c},
          {-sign_ * v * c, -v * s},
          {sign_ * (inward * s - along * c), -inward * c - along * s}};
}

Motion<double> SliderCrank::rod_angle(const Motion<double>& theta) const {
  const auto pin = crank_pin(theta);
  const double sine = (pin.position.x() - pin_offset_) / rod_length_;
  const double sine_1 = pin.velocity.x() / rod_length_;
  const double sine_2 = pin.acceleration.x() / rod_length_;
  const double cosine = std::sqrt(1.0 - sine * sine);
  const double rate = sine_1 / cosine;
  return {std::asin(sine), rate, (sine_2 + rate * rate * sine) / cosine};
}

Motion<Eigen::Vector2d> SliderCrank::rod_point(const Motion<double>& theta, double distance) const {
  const auto pin = crank_pin(theta);
  const auto phi = rod_angle(theta);
  const Eigen::Vector2d along = rod_direction(phi.position);
  const Eigen::Vector2d across(-along.y(), along.x());  // d along / d phi
  const double w = phi.velocity;
  return {pin.position + distance * along, pin.velocity + distance * w * across,
          pin.acceleration + distance * (phi.acceleration * across - w * w * along)};
}

Motion<double> SliderCrank::piston_pin(const Motion<double>& theta) const {
  const auto end = rod_point(theta, rod_length_);
  return {end.position.y(), end.velocity.y(), end.acceleration.y()};
}

Eigen::Vector2d rod_direction(double phi) { return {-std::sin(phi), std::cos(phi)}; }

}  // namespace clatter::dynamics
