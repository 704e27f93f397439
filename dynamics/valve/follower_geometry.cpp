// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/follower_geometry.hpp"

#include <cmath>
#include <complex>

namespace clatter::dynamics {
namespace {

using Complex = std::complex<double>;
constexpr Complex kI{0.0, 1.0};

Complex of(const Eigen::Vector2d& vector) { return {vector.x(), vector.y()}; }
Eigen::Vector2d of(const Complex& number) { return {number.real(), number.imag()}; }
/// a x b.
double cross(const Complex& a, const Complex& b) { return (std::conj(a) * b).imag(); }

}  // namespace

FollowerState follower_at(const FollowerGeometry& geometry, const SplinePoint& lift, double angle,
                          double turn) {
  const double length = geometry.pad.norm();
  const double beta = std::atan2(geometry.pad.y(), geometry.pad.x());
  const double sine = (lift.value - geometry.pad.y()) / length, from = std::asin(sine);
  const double cosine = length * std::cos(from);
  FollowerState state;
  state.tilt = beta + from;
  state.tilt_by_angle = lift.first / cosine;
  const double rate = state.tilt_by_angle,
               second = (lift.second + length * sine * rate * rate) / cosine;

  const Complex turned = std::exp(-kI * state.tilt);
  const Complex roller = turned * of(geometry.roller), pad = turned * of(geometry.pad);
  state.roller = of(roller);
  state.pad = of(pad);
  // In axes that turn with the cam: the pitch curve e^(-i turn angle) (roller - centre).
  const Complex arm = roller - of(geometry.cam), spin = kI * turn;
  const Complex first = -kI * rate * roller - spin * arm;
  const Complex curving =
      (-kI * second - rate * rate) * roller + 2.0 * spin * kI * rate * roller - arm;
  const Complex back = std::exp(-spin * angle);
  state.pitch = of(back * arm);
  const double speed = std::abs(first);
  Complex normal = kI * first / speed;
  double side = -1.0;
  if ((std::conj(normal) * arm).real() < 0.0) {
    normal = -normal;
    side = 1.0;
  }
  state.normal = of(normal);
  state.curvature = side * cross(first, curving) / (speed * speed * speed);
  // Moments about the ball: of the roller's force along the normal, of a unit force up on the pad.
  state.roller_force = -cross(pad, kI) / cross(roller, normal);
  state.ball_force = of(state.roller_force * normal + kI);
  return state;
}

}  // namespace clatter::dynamics
