// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics {
namespace {

using testing::point_mass;
using testing::push;
using testing::vector;

/// Position of a 1 kg mass on a 400 N/m spring with 2 N s/m, released at 1 mm, after 0.5 s.
double exact_damped(double t) {
  const double w0 = 20.0, zeta = 2.0 / (2.0 * 20.0), wd = w0 * std::sqrt(1.0 - zeta * zeta);
  return 1e-3 * std::exp(-zeta * w0 * t) * (std::cos(wd * t) + zeta * w0 / wd * std::sin(wd * t));
}

double error_with_step(const Tableau& tableau, double dt) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0, 400.0, 2.0)), 0);
  StepOptions options;
  options.method = &tableau;
  options.largest = dt;
  options.first = 1e-9;  // the starting stage is of first order: too short to be seen
  options.fixed = true;
  const auto method = make_integrator(system, options);
  method->start(-options.first, vector(1e-3), vector(0.0));
  while (method->state().time < 0.5 - 1e-12) method->step(0.5);
  return std::abs(method->state().y(y) - exact_damped(0.5));
}

TEST(Integrator, HalvingTheStepQuartersTheError) {
  for (const Tableau* tableau : {&tr_bdf2(), &sdirk2(), &predictor_corrector()}) {
    const double coarse = error_with_step(*tableau, 4e-3), middle = error_with_step(*tableau, 2e-3),
                 fine = error_with_step(*tableau, 1e-3);
    // Second order: the ratio tends to 4; 3 % covers the next term at these steps.
    EXPECT_NEAR(coarse / middle, 4.0, 0.12) << tableau->name;
    EXPECT_NEAR(middle / fine, 4.0, 0.12) << tableau->name;
  }
}

TEST(Dirk, TableausAreConsistentAndStifflyAccurate) {
  for (const Tableau* t : {&tr_bdf2(), &sdirk2()}) {
    EXPECT_NEAR(t->a_10 + t->d, t->c_1, 1e-15);
    EXPECT_NEAR(t->b[0] + t->b[1] + t->b[2], 1.0, 1e-15);
    EXPECT_NEAR(t->b_hat[0] + t->b_hat[1] + t->b_hat[2], 1.0, 1e-15);
    EXPECT_NEAR(t->b[1] * t->c_1 + t->b[2], 0.5, 1e-15);                         // order 2
    EXPECT_NEAR(t->b_hat[1] * t->c_1 + t->b_hat[2], 0.5, 1e-15);                 // order 2
    EXPECT_NEAR(t->b_hat[1] * t->c_1 * t->c_1 + t->b_hat[2], 1.0 / 3.0, 1e-15);  // order 3
    EXPECT_EQ(t->b[1], t->a_21);
    EXPECT_EQ(t->b[2], t->d);
  }
}

/// A method and its global error over tolerance^(2/3) on the oscillator below.
struct Adaptive {
  const Tableau* method;
  double factor;
};

class AdaptiveSteps : public ::testing::TestWithParam<Adaptive> {};
INSTANTIATE_TEST_SUITE_P(Integrator, AdaptiveSteps,
                         ::testing::Values(Adaptive{&tr_bdf2(), 2.0}, Adaptive{&sdirk2(), 4.0},
                                           Adaptive{&predictor_corrector(), 2.0}),
                         [](const auto& info) {
                           std::string name = info.param.method->name;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(AdaptiveSteps, MeetTheirTolerance) {
  double previous = 1.0;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    System system;
    const int y = system.coordinate(system.add_body(point_mass(1.0, 400.0, 2.0)), 0);
    StepOptions options;
    options.largest = 0.1;
    options.first = 1e-6;
    options.method = GetParam().method;
    options.accuracy = {tolerance, 1e-3, 2e-2, 1.0};
    const auto method = make_integrator(system, options);
    method->start(-options.first, vector(1e-3), vector(0.0));
    while (method->state().time < 0.5) method->step(0.5);
    const double error = std::abs(method->state().y(y) - exact_damped(0.5));
    // Second order at a local error limit: the global error goes with tolerance^(2/3), a factor of
    // 4.6 here; and it adds up over about three periods.
    EXPECT_LT(error, 0.4 * previous);
    EXPECT_LT(error, GetParam().factor * std::pow(tolerance, 2.0 / 3.0) * 1e-3);
    EXPECT_DOUBLE_EQ(method->state().time, 0.5);
    previous = error;
  }
}

TEST(Dirk, StepResponseOfAnOscillatorIsOneMinusCosine) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(2.0, 800.0)), 0);
  push(system, [](double) { return 8.0; });
  StepOptions options;
  options.largest = 1e-3;
  options.first = 1e-8;
  options.accuracy = {1e-4, 1e-2, 0.2, 1.0};
  Dirk method(system, options);
  method.start(0.0, vector(0.0), vector(0.0));
  double worst = 0.0;
  while (method.state().time < 1.0) {
    method.step(1.0);
    const double exact = 0.01 * (1.0 - std::cos(20.0 * method.state().time));
    worst = std::max(worst, std::abs(method.state().y(y) - exact));
  }
  EXPECT_LT(worst, 1e-4 * 0.01 * 50);  // 50 times the local limit after three undamped periods
}

TEST(Dirk, QuasiStaticModeFollowsItsLoad) {
  System system;
  ModalBody body = point_mass(1.0, 1e6);
  body.inertia.setZero();
  const int y = system.coordinate(system.add_body(std::move(body)), 0);
  push(system, [](double t) { return 1e3 * std::sin(50.0 * t); });
  StepOptions options;
  options.largest = 1e-3;
  Dirk method(system, options);
  method.start(0.0, vector(0.0), vector(0.0));
  while (method.state().time < 0.2) {
    method.step(0.2);
    EXPECT_NEAR(method.state().y(y), 1e-3 * std::sin(50.0 * method.state().time), 1e-15);
  }
}

TEST(Energy, BalanceClosesForADrivenDampedOscillator) {
  System system;
  system.coordinate(system.add_body(point_mass(1.0, 400.0, 2.0)), 0);
  push(system, [](double t) { return std::sin(15.0 * t); });
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-2;
  options.accuracy = {1e-3, 1e-3, 2e-2, 1.0};
  Dirk method(system, options);
  method.set_observer(&energy);
  method.start(0.0, vector(0.0), vector(0.0));
  while (method.state().time < 5.0) method.step(5.0);
  EXPECT_GT(energy.now().input, 0.0);
  EXPECT_GT(energy.now().lost, 0.0);
  // The local error limit is 1e-3 of the motion's scale a step.
  EXPECT_LT(energy.residue(), 2e-3);
}

}  // namespace
}  // namespace clatter::dynamics
