// SPDX-License-Identifier: GPL-3.0-or-later
// Friction that sticks: limits, derivatives, losses.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dynamics/law/bristle.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

constexpr double kSpring = 1e6, kDashpot = 50.0, kBristleStep = 1e-4;

/// One step of implicit Euler.
Bristle::Force advance(Bristle& bristle, const Vector2d& slip, double normal) {
  const Stage stage{0.0, kBristleStep, 1, {0.0}};
  const Bristle::Force force = bristle.evaluate(stage, slip, normal);
  bristle.finish_stage(stage);
  bristle.accept_step();
  return force;
}

TEST(Bristle, IsASpringBelowItsLimitAndCoulombsFrictionAtIt) {
  Bristle bristle(kSpring, 0.0, 1.0, 1.0);
  const Vector2d slip(3e-3, -4e-3);
  // 5e-7 m a step, the limit at 2e-6 m.
  for (int k = 1; k <= 8; ++k) {
    const Bristle::Force force = advance(bristle, slip, 2.0);
    EXPECT_NEAR(force.value.norm(), std::min(0.5 * k, 2.0), 1e-12) << k;
    EXPECT_NEAR(force.value.dot(slip), force.value.norm() * slip.norm(), 1e-15);
    EXPECT_NEAR(bristle.stored(), 0.5 * std::pow(force.value.norm(), 2) / kSpring, 1e-18);
  }
  EXPECT_NEAR(bristle.lost(slip), 2.0 * slip.norm(), 1e-14);
}

TEST(Bristle, BreaksAwayAtItsCoefficientAtRestAndSlidesWithTheKineticOne) {
  Bristle bristle(kSpring, 0.0, 0.2, 0.3);
  const Vector2d slip(5.2e-3, 0.0);  // 0.52 N a step
  double most = 0.0;
  for (int k = 0; k < 20; ++k) most = std::max(most, advance(bristle, slip, 10.0).value.x());
  EXPECT_NEAR(most, 5 * 0.52, 1e-12);
  EXPECT_NEAR(advance(bristle, slip, 10.0).value.x(), 2.0, 1e-12);
  // It sticks as the slip ends, and breaks away anew.
  advance(bristle, -slip, 10.0);
  for (int k = 0; k < 2; ++k) most = advance(bristle, slip, 10.0).value.x();
  EXPECT_NEAR(most, 2.52, 1e-12);
}

TEST(Bristle, KeepsItsForceAtRestForEver) {
  Bristle bristle(kSpring, kDashpot, 1.0, 1.0);
  Bristle::Force force = advance(bristle, {1e-2, 0.0}, 5.0);
  for (int k = 0; k < 10000; ++k) force = advance(bristle, Vector2d::Zero(), 5.0);
  EXPECT_NEAR(force.value.x(), kSpring * 1e-2 * kBristleStep, 1e-12);
}

TEST(Bristle, DerivativesAreDifferenceQuotients) {
  const Stage stage{0.0, kBristleStep, 1, {0.5 * kBristleStep}};
  for (const double normal : {100.0, 2.0}) {  // sticks, slides
    Bristle bristle(kSpring, kDashpot, 1.0, 1.0);
    advance(bristle, {5e-3, 2e-3}, normal);
    const Vector2d slip(0.02, -0.07);
    const Bristle::Force at = bristle.evaluate(stage, slip, normal);
    const double h = 1e-7;
    for (int k = 0; k < 2; ++k) {
      const Vector2d way = h * Vector2d::Unit(k);
      const Vector2d quotient = (bristle.evaluate(stage, slip + way, normal).value -
                                 bristle.evaluate(stage, slip - way, normal).value) /
                                (2.0 * h);
      EXPECT_LT((quotient - at.by_slip.col(k)).norm(), 1e-6 * at.by_slip.norm() + 1e-9) << normal;
    }
    const Vector2d by_normal = (bristle.evaluate(stage, slip, normal * 1.001).value -
                                bristle.evaluate(stage, slip, normal * 0.999).value) /
                               (0.002 * normal);
    EXPECT_LT((by_normal - at.by_normal).norm(), 1e-9) << normal;
  }
}

TEST(Bristle, NeverGainsEnergyWhateverSlipAndLoadDo) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Bristle bristle(kSpring, kDashpot, 1.0, 1.0);
  double least = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const Vector2d slip(0.1 * any(random), 0.1 * any(random));
    const double normal = 10.0 * std::max(any(random), 0.0);  // half of the time it is open
    const Bristle::Force force = advance(bristle, slip, normal);
    EXPECT_LE(force.value.norm(), normal * (1.0 + 1e-12));
    least = std::min(least, bristle.lost(slip));
  }
  test::expect_at_least("power that friction loses [W]", least, -1e-14);
}

}  // namespace
}  // namespace clatter::dynamics
