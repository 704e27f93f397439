// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case 7: coils that clash.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "dynamics/valve/coil_spring.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;

std::unique_ptr<Port> sliding(int y, double x) {
  const Vector3d at(x, 0.0, 0.0);
  return std::make_unique<SlidePort>(y, Vector3d::UnitX(), at, std::make_unique<GroundPort>(at),
                                     at);
}

/// Two bodies of 80 g with the spring of the reference between them fly at each other: 16 m/s are
/// far more than its 8.7 mm to solid can take.
TEST(CoilClash, HardTD7_TheSpringIsNeverBelowSolidAndMomentumIsKept) {
  for (const double stiffness : {1e7, CoilSpringSpec{}.clash_stiffness, 1e9}) {
    CoilSpringSpec spec;
    spec.clash_stiffness = stiffness;
    System system;
    const int a =
        system.coordinate(system.add_body(make_sliding_body("a", 0.08, Vector3d::UnitX(), 8.0)), 0);
    const int b = system.coordinate(
        system.add_body(make_sliding_body("b", 0.08, Vector3d::UnitX(), -8.0)), 0);
    const int coils =
        system.add_body(make_coil_body("coils", spec, Vector3d::UnitX(), {0.0, 0.0, 8.0, -8.0}));
    std::vector<int> y;
    for (int k = 0; k < spec.masses; ++k) y.push_back(system.coordinate(coils, k));
    CoilEnd left(sliding(a, 0.0), Vector3d::UnitX(), Vector3d::Zero()),
        right(sliding(b, 0.04), Vector3d::UnitX(), Vector3d(0.04, 0.0, 0.0));
    auto made = std::make_unique<CoilSpring>("spring", std::move(left), std::move(right), y, spec);
    const CoilSpring& spring = *made;
    system.add_element(std::move(made));
    StepOptions options;
    options.accuracy.tolerance = 1e-4;
    const auto method = testing::started(system, options);
    double least = 1.0, shortest = 1.0, largest_force = 0.0, energy = 1e9;
    while (method->state().time < 10e-3) {
      method->step(10e-3);
      const auto& now = method->state();
      least = std::min(least, spring.accepted().least_gap);
      shortest = std::min(shortest, spec.to_solid + now.y(b) - now.y(a));
      largest_force = std::max(largest_force, spring.accepted().force);
      double momentum = 0.08 * (now.v_y(a) + now.v_y(b)), kinetic = 0.0;
      for (const int k : {a, b}) kinetic += 0.04 * now.v_y(k) * now.v_y(k);
      for (const int k : y) {
        momentum += spec.mass / spec.masses * now.v_y(k);
        kinetic += 0.5 * spec.mass / spec.masses * now.v_y(k) * now.v_y(k);
      }
      // Of 0.6 kg m/s in either direction; the rest is rounding and Newton's iteration.
      ASSERT_NEAR(momentum, 0.0, 1e-9);
      const Power power = [&] {
        const auto& at = spring.coordinates();
        return spring.power(gather(now.y, at), gather(now.v_y, at));
      }();
      ASSERT_GE(power.lost, -1e-9);
      const double total = kinetic + power.stored;
      ASSERT_LT(total, energy * (1.0 + 1e-4));  // the tolerance
      energy = total;
    }
    // Coils that touch bear the force by their own stiffness.
    EXPECT_LT(shortest, 0.0);
    // Coils meet each other with less than half of the ends' speed.
    const double impact = 8.0 * std::sqrt(0.5 * spec.mass / spec.masses / stiffness);
    EXPECT_GT(least, -largest_force / stiffness - impact);
    EXPECT_GT(shortest, -(spec.masses + 1) * largest_force / stiffness);
    std::printf(
        "contact %.0e N/m: %.0f N, coils %.2f um into each other, spring %.1f um below "
        "solid, %lld steps\n",
        stiffness, largest_force, -1e6 * least, -1e6 * shortest,
        static_cast<long long>(method->statistics().accepted));
    // It opens again.
    EXPECT_GT(method->state().v_y(b) - method->state().v_y(a), 0.0);
  }
}

}  // namespace
}  // namespace clatter::dynamics
