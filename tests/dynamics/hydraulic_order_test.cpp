// SPDX-License-Identifier: GPL-3.0-or-later
// Order of the chamber's pressure in the step.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/hydraulic_rig.hpp"

namespace clatter::dynamics {
namespace {

/// Pressure of a chamber whose plunger oscillates by 0.2 mm at 85 Hz, after a period and a quarter:
/// between 1.6 and 22 bar, with leak and without flow through the valve.
double pressure_by(const Tableau* method, double dt) {
  ChamberSpec spec = testing::reference_tensioner();
  spec.valve.ball = CheckValveSpec::Ball::kStuckShut;
  testing::HydraulicRig rig(spec, 3.5e5, 3.5e5, testing::sine(-0.2e-3, 85.0));
  auto options = testing::equal_steps(dt, method);
  options.accuracy.tolerance = 1e-9;
  rig.start(options);
  rig.run_to(1.25 / 85.0);
  return rig.pressure();
}

TEST(HydraulicOrder, HalvingTheStepQuartersTheErrorOfThePressure) {
  const double span = 1.25 / 85.0;
  for (const Tableau* method : {&tr_bdf2(), &sdirk2(), &predictor_corrector()}) {
    const double exact = pressure_by(method, span / 6400);
    const double coarse = pressure_by(method, span / 200) - exact,
                 middle = pressure_by(method, span / 400) - exact,
                 fine = pressure_by(method, span / 800) - exact;
    // The finest result has 1/64 of the error of `fine`.
    EXPECT_NEAR(coarse / middle, 4.0, 0.3) << method->name;
    EXPECT_NEAR(middle / fine, 4.0, 0.2) << method->name;
  }
}

}  // namespace
}  // namespace clatter::dynamics
