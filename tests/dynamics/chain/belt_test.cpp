// SPDX-License-Identifier: GPL-3.0-or-later
// Taut belts around circles.
#include "dynamics/chain/belt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

constexpr double kPi = std::numbers::pi;
constexpr double kPitch = 8e-3;

BeltCircle sprocket(const Vector2d& centre_mm, int teeth, int owner, Turn turn = Turn::kClockwise) {
  const double radius = 0.5 * kPitch / std::sin(kPi / teeth);
  return {1e-3 * centre_mm, radius, turn, owner, teeth * kPitch / (2.0 * kPi), false};
}

BeltCircle guide(const Vector2d& centre_mm, double radius_mm, int owner) {
  return {1e-3 * centre_mm, 1e-3 * (radius_mm + 3.6), Turn::kCounterClockwise, owner, 0.0, true};
}

const std::vector<std::string> kNames{"crank", "arm", "intake", "exhaust", "guide"};

std::vector<BeltCircle> timing_drive() {
  return {sprocket({0.0, 0.0}, 20, 0), guide({-310.1, 88.9}, 280.0, 1),
          sprocket({-60.0, 326.0}, 40, 2), sprocket({60.0, 326.0}, 40, 3),
          guide({1221.8, -152.5}, 1200.0, 4)};
}

TEST(Belt, TwoEqualPulleysGiveTheTextbookLength) {
  const Belt belt = taut_belt({{Vector2d(0.0, 0.0), 0.1, Turn::kClockwise, 0},
                               {Vector2d(0.5, 0.0), 0.1, Turn::kClockwise, 1}},
                              {"a", "b"});
  EXPECT_NEAR(belt.length, 2.0 * 0.5 + 2.0 * kPi * 0.1, 1e-15);
  EXPECT_NEAR(belt.wrap(0), kPi, 1e-15);
}

TEST(Belt, CrossedPulleysGiveTheTextbookLength) {
  // The crossed belt: 2 sqrt(d^2 - (r + R)^2) + (r + R)(pi + 2 asin((r + R) / d)).
  const Belt belt = taut_belt({{Vector2d(0.0, 0.0), 0.1, Turn::kClockwise, 0},
                               {Vector2d(0.5, 0.0), 0.05, Turn::kCounterClockwise, 1}},
                              {"a", "b"});
  const double sum = 0.15;
  EXPECT_NEAR(belt.length,
              2.0 * std::sqrt(0.25 - sum * sum) + sum * (kPi + 2.0 * std::asin(sum / 0.5)), 1e-15);
}

TEST(Belt, OracleOfTheTimingDrive) {
  const Belt belt = taut_belt(timing_drive(), kNames);
  const auto teeth = [&](int owner, int z) { return belt.wrap(owner) * z / (2.0 * kPi); };
  // reference/timing-drive.md, whole drive; lengths in pitches, to the digits given.
  // (of the wrap of the crank all but the last, which the rounded centres of the guides decide)
  EXPECT_NEAR(teeth(0, 20), 9.38561, 2e-5);
  EXPECT_NEAR(teeth(3, 40), 12.13726, 5e-6);
  EXPECT_NEAR(teeth(2, 40), 13.28948, 5e-6);
  EXPECT_NEAR(belt.length, 1.04202685, 5e-9);
  double tight = 0.0;
  for (const BeltPart& part : belt.parts) {
    if (part.straight && part.owner == 2) {
      EXPECT_NEAR(part.length / kPitch, 15.0, 1e-12);
    }
    if (part.owner == 4 || (part.straight && part.owner == 3)) tight += part.length;
  }
  EXPECT_NEAR(tight / kPitch, 40.65374, 5e-6);
}

TEST(Belt, PointsAlongItAreContinuousAndAsFarApartAsTheyShould) {
  const Belt belt = taut_belt(timing_drive(), kNames);
  const double step = 1e-4;
  for (double s = -0.1; s < belt.length; s += step) {
    const double distance = (belt.at(s + step) - belt.at(s)).norm();
    // On a sprocket the belt's length is that of the teeth, 0.4 % less than the arc's at 20 teeth.
    EXPECT_NEAR(distance, step, 0.005 * step) << s;
  }
}

TEST(Belt, AGuideBesideTheSpanIsMissed) {
  std::vector<BeltCircle> circles = timing_drive();
  circles[4].centre.x() += 0.03;
  const Belt belt = taut_belt(circles, kNames);
  EXPECT_EQ(belt.wrap(4), 0.0);
  EXPECT_EQ(belt.middle(4), -1.0);
  EXPECT_GT(belt.middle(3), 0.0);
}

TEST(Belt, OverlappingCirclesAreRefusedByName) {
  std::vector<BeltCircle> circles = timing_drive();
  circles[2].turn = Turn::kCounterClockwise;
  circles[2].centre.x() += 0.1;
  try {
    taut_belt({circles[2], circles[3]}, kNames);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "no straight span joins intake and exhaust: their circles are 20 mm apart, "
                 "expected more than 102 mm");
  }
}

}  // namespace
}  // namespace clatter::dynamics
