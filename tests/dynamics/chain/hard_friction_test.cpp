// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case TD11: friction with a regularisation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/chain/profile_contact.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

constexpr double kFriction = 0.08, kMass = 2.4e-3, kGravity = 9.81;

/// A link that lies on a guide inclined by `slope` [rad], left alone: how far it is down the guide
/// and how fast after `seconds`.
struct Slid {
  double way = 0.0, speed = 0.0, crept = 0.0;
};

Slid slide(double slope, double slip_speed, double seconds) {
  System system;
  ChainMake make;
  make.kinds = {LinkKind::kInner};
  make.pitches = {8e-3};
  make.inner = {kMass, 4.4e-8};
  make.closed = false;
  const Vector2d along(std::cos(slope), -std::sin(slope)), up(std::sin(slope), std::cos(slope));
  MattressLaw law{};
  law.stiffness = 5.357e11;
  law.width = 2.4e-3;
  law.damping = 0.5;
  law.friction = kFriction;
  law.slip_speed = slip_speed;
  PlanarMotion start;
  start.centre = 3.6e-3 * up;
  start.angle = -slope;
  const std::vector<int> y = testing::add_planar(system, "link", kMass, 4.4e-8, start);
  ProfileCarrier carrier;
  carrier.port = std::make_unique<GroundPort>(Eigen::Vector3d::Zero());
  LinkOutlines outlines;
  outlines.inner = outlines.outer = {LinkOutline::plate(-4e-3, 4e-3, 3.6e-3)};
  const auto guide =
      std::make_shared<const Profile>(std::vector<Segment>{LineSegment{5.0 * along, -0.5 * along}});
  system.add_element(
      std::make_unique<ProfileContact>("guide", y, make, guide, outlines, law, std::move(carrier)));
  Load weight;
  weight.term = "weight";
  weight.direction =
      system.bodies()[0].shapes.topRows<2>().transpose() * Vector2d(0.0, -kMass * kGravity);
  weight.value = [](double) { return 1.0; };
  system.add_load(weight);
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy.tolerance = 1e-4;
  const auto method = testing::started(system, options);
  while (method->state().time < seconds) method->step(seconds);
  const StageState& state = method->state();
  return {Vector2d(state.y(0), state.y(1)).dot(along),
          Vector2d(state.v_y(0), state.v_y(1)).dot(along), system.element(0).crept().value()};
}

TEST(HardTD11_Friction, ALinkThatSticksCreepsInProportionToTheRegularisationSpeed) {
  // tan(slope) = mu (3 x - x^3) / 2 at a speed of x times the regularisation speed.
  const double x = 0.4, slope = std::atan(kFriction * 0.5 * (3.0 * x - x * x * x));
  for (const double slip_speed : {0.02, 0.005, 0.001}) {
    const Slid found = slide(slope, slip_speed, 0.3);
    test::expect_at_most("error of the creep, of the speed of regularisation",
                         std::abs(found.speed / slip_speed - x), 1e-4);
    EXPECT_LT(found.way, x * slip_speed * 0.3) << slip_speed;
    EXPECT_NEAR(found.crept, found.way, 0.01 * found.way) << slip_speed;
  }
}

TEST(HardTD11_Friction, ALinkThatSlidesTendsToCoulombsFriction) {
  const double slope = 2.0 * std::atan(kFriction), seconds = 0.3;
  const double acceleration = kGravity * (std::sin(slope) - kFriction * std::cos(slope)),
               way = 0.5 * acceleration * seconds * seconds;
  // Below the regularisation speed the acceleration is larger: for a time in proportion to it.
  double before = 0.0;
  for (const double slip_speed : {0.04, 0.02, 0.01}) {
    const Slid found = slide(slope, slip_speed, seconds);
    const double error = found.way - way;
    // What slides crept until it had the speed of regularisation, which took less than Coulomb's
    // friction would have.
    EXPECT_LT(found.crept, 0.5 * slip_speed * slip_speed / acceleration) << slip_speed;
    EXPECT_GT(found.crept, 0.1 * slip_speed * slip_speed / acceleration) << slip_speed;
    EXPECT_GT(error, 0.0) << slip_speed;
    if (before > 0.0) {
      EXPECT_NEAR(before / error, 2.0, 0.15) << slip_speed;
    }
    before = error;
  }
  test::expect_at_most("error of a sliding link", before / way, 0.02);
}

}  // namespace
}  // namespace clatter::dynamics
