// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/given/crank.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kOmega = 2000.0 * std::numbers::pi / 30.0;
const CrankClock kUneven{kOmega, {{2.0, 10.0, 0.3}, {0.5, 4.0, 0.0}}};

TEST(SliderCrank, PinHeightMatchesTheClosedForm) {
  const SliderCrank crank(0.065, 0.21, 0.001, CrankClock{kOmega});
  for (double theta = -6.0; theta < 7.0; theta += 0.37) {
    const double s = 0.065 * std::sin(theta) + 0.001;
    const double z = 0.065 * std::cos(theta) + std::sqrt(0.21 * 0.21 - s * s);
    EXPECT_NEAR(crank.piston_pin(crank.time(theta)).position, z, 1e-15);
  }
}

void expect_derivatives(const SliderCrank& crank) {
  const double h = 1e-6;
  for (double t = -0.02; t < 0.03; t += 0.0017) {
    const auto difference = [&](auto value) { return (value(t + h) - value(t - h)) / (2.0 * h); };
    const auto pin = crank.piston_pin(t);
    // Central differences: h^2 z''' / 6 = 1e-7 relative, and rounding 1e-10 / h of the
    // acceleration.
    EXPECT_NEAR(pin.velocity, difference([&](double x) { return crank.piston_pin(x).position; }),
                1e-5);
    EXPECT_NEAR(pin.acceleration,
                difference([&](double x) { return crank.piston_pin(x).velocity; }), 1e-2);
    const auto phi = crank.rod_angle(t);
    EXPECT_NEAR(phi.velocity, difference([&](double x) { return crank.rod_angle(x).position; }),
                1e-5);
    EXPECT_NEAR(phi.acceleration, difference([&](double x) { return crank.rod_angle(x).velocity; }),
                1e-1);
    const auto point = crank.rod_point(t, 0.07);
    EXPECT_NEAR(point.acceleration.x(),
                difference([&](double x) { return crank.rod_point(x, 0.07).velocity.x(); }), 1e-2);
  }
}

TEST(SliderCrank, DerivativesMatchDifferences) {
  expect_derivatives({0.065, 0.21, 0.002, CrankClock{kOmega}});
  expect_derivatives({0.065, 0.21, 0.002, kUneven, 2.0, Rotation::kBackward});
}

TEST(CrankClock, FluctuatesAroundItsMeanAndRepeats) {
  const double cycle = kUneven.cycle();
  EXPECT_NEAR(cycle, 0.06, 1e-15);
  for (double t = -0.05; t < 0.06; t += 0.0031) {
    EXPECT_NEAR(kUneven.angle(t + cycle) - kUneven.angle(t), 4.0 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(kUneven.time(kUneven.angle(t)), t, 1e-16);
    const double w = 2.0 * kOmega, half = 0.5 * kOmega;
    EXPECT_NEAR(kUneven.turn(t).velocity,
                kOmega + 10.0 * std::cos(w * t + 0.3) + 4.0 * std::cos(half * t), 1e-12);
  }
  EXPECT_DOUBLE_EQ(kUneven.angle(0.0), 0.0);
}

TEST(SliderCrank, AccelerationAtTopDeadCentre) {
  const SliderCrank crank(0.065, 0.21, 0.0, CrankClock{kOmega});
  // - r omega^2 (1 + r / l)
  EXPECT_NEAR(crank.piston_pin(0.0).acceleration, -0.065 * kOmega * kOmega * (1.0 + 0.065 / 0.21),
              1e-9);
  EXPECT_NEAR(crank.crank_pin(crank.time(0.5 * std::numbers::pi)).position.x(), -0.065, 1e-15);
}

TEST(SliderCrank, RefusesARodThatDoesNotReach) {
  test::expect_parts(test::refusal_of([&] { SliderCrank(0.065, 0.06, 0.0, CrankClock{1.0}); }),
                     {"slider-crank: crank radius 0.065 m, rod 0.06 m, pin offset 0 m: expected "
                      "rod > radius + offset"});
}

}  // namespace
}  // namespace clatter::dynamics
