// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases of hydraulic elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/dynamics/hydraulic_rig.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using Ball = CheckValveSpec::Ball;
using testing::HydraulicRig;

class Cavitating : public ::testing::TestWithParam<Ball> {};
INSTANTIATE_TEST_SUITE_P(HardTD5, Cavitating, ::testing::Values(Ball::kQuasiStatic, Ball::kMoving));

TEST_P(Cavitating, HardTD5_TheChambersPressureStaysPositiveAndNoOilIsLost) {
  ChamberSpec spec;
  spec.valve.ball = GetParam();
  // 16 mm out and back in 10 ms: 5 m/s, five times what the valve lets in.
  HydraulicRig rig(spec, 3.5e5, 3.5e5, [](double t) {
    const double w = 2.0 * std::numbers::pi * 100.0;
    return Motion<double>{8e-3 * (1.0 - std::cos(w * t)), 8e-3 * w * std::sin(w * t), 0.0};
  });
  StepOptions options;
  options.largest = 2e-5;
  options.accuracy.tolerance = 1e-4;
  rig.method = make_integrator(rig.system, options);
  testing::OilBalance balance(*rig.element, *options.method);
  rig.method->set_observer(&balance);
  rig.method->start(0.0, rig.system.eta_start(), rig.system.v_start());
  const ChamberFluid& fluid = rig.element->chamber().fluid();
  double lowest = 1e9, highest = 0.0;
  while (rig.method->state().time < 0.03) {
    rig.method->step(0.03);
    const auto& at = rig.element->accepted();
    lowest = std::min(lowest, rig.pressure());
    highest = std::max(highest, rig.pressure());
    ASSERT_GT(rig.pressure(), 0.0);
    // The whole volume is filled by the fluid's law: none is cut off.
    ASSERT_NEAR(fluid.density(rig.pressure()) * at.chamber.volume / at.content, 1.0, 1e-12);
    const double swept =
        GetParam() == Ball::kMoving ? spec.valve.seat_area() * at.chamber.lift : 0.0;
    // A ball is up to 21 um in its seat, at 290 bar; the plunger sweeps 1.3 cm3.
    ASSERT_NEAR(at.chamber.volume, spec.volume + spec.area() * at.travel - swept,
                3e-5 * spec.valve.seat_area());
  }
  EXPECT_LT(lowest, 0.1e5);
  EXPECT_GT(highest, 20e5);
  EXPECT_GT(balance.exchanged(), 1e-4);
  test::expect_at_most("residue of the balance of oil and energy", balance.residue(), 1e-9);
}

/// Mean pressure [Pa] of the last five of ten periods of 85 Hz, 0.1 mm.
struct Shaken {
  double mean = 0.0, highest = 0.0, lowest = 1e12, content = 0.0;
};

Shaken shaken(const ChamberSpec& spec, double supply) {
  HydraulicRig rig(spec, supply, supply, testing::sine(0.1e-3, 85.0));
  rig.start(testing::equal_steps(1.0 / 85.0 / 500.0));
  rig.run_to(5.0 / 85.0);
  Shaken result;
  for (int i = 0; i < 2500; ++i) {
    rig.run_to((5.0 + (i + 1) / 500.0) / 85.0);
    result.mean += rig.pressure() / 2500.0;
    result.highest = std::max(result.highest, rig.pressure());
    result.lowest = std::min(result.lowest, rig.pressure());
  }
  result.content = rig.element->accepted().content;
  return result;
}

TEST(Hydraulic, HardTD6_ACheckValveStuckShutLetsTheChamberRunEmptyToTheOutsidePressure) {
  ChamberSpec works, stuck;
  stuck.valve.ball = Ball::kStuckShut;
  const Shaken right = shaken(works, 3.5e5), found = shaken(stuck, 3.5e5);
  // The leak goes outside and nothing comes in; the working valve holds 3.5 bar at least.
  EXPECT_GT(right.lowest, 3.3e5);
  EXPECT_LT(found.lowest, 1.0e5);
  EXPECT_LT(found.mean, 0.5 * right.mean);
  EXPECT_LT(found.content, right.content);
  EXPECT_GT(found.lowest, 0.0);
}

TEST(Hydraulic, HardTD6_ACheckValveStuckOpenHoldsNoPressure) {
  ChamberSpec works = testing::reference_tensioner(), stuck = works;
  stuck.valve.ball = Ball::kStuckOpen;
  const Shaken right = shaken(works, 3.5e5), found = shaken(stuck, 3.5e5);
  // 0.1 mm at 85 Hz is 53 mm/s: the open valve needs (0.053 / 1.012)^2 of 3.5 bar for it.
  test::expect_at_most("change of pressure with a valve stuck open [Pa]",
                       found.highest - found.lowest, 0.03e5);
  EXPECT_NEAR(found.mean, 3.5e5, 0.01e5);
  EXPECT_GT(right.highest, 5e5);
}

TEST(Hydraulic, HardTD6_ADryChamberIsAnAirSpringWithoutHold) {
  ChamberSpec dry;
  dry.dry = true;
  dry.oil = dry_air(1.4);
  const Shaken found = shaken(dry, 1e5);
  // E = k p: +- 0.1 mm changes the volume by 0.31 %, the pressure of a sealed chamber by 0.44 %.
  test::expect_at_most("error of the pressure of a dry chamber [Pa]", std::abs(found.mean - 1e5),
                       0.0044e5);
  EXPECT_LT(found.highest - found.lowest, 0.0089e5);
}

}  // namespace
}  // namespace clatter::dynamics
