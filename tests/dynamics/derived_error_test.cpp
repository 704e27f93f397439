// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of errors of forces and accelerations.
#include "dynamics/integrate/derived_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kMass = 2.0, kStiffness = 1e9, kSpeed = 0.1;

/// A mass that meets an elastic wall without loss.
struct Impact {
  double error = 0.0;  // of the force, the largest until it leaves [N]
  long long steps = 0;
};

Impact impact(const Tableau& method, const Accuracy& accuracy) {
  System system;
  const int y = system.coordinate(system.add_body(testing::point_mass(kMass)), 0);
  system.add_element(std::make_unique<testing::Wall>(y, 0.0, kStiffness, 0.0, 1.0));
  StepOptions options;
  options.method = &method;
  options.largest = 1e-4;
  options.first = 1e-9;
  options.accuracy = accuracy;
  const auto run = make_integrator(system, options);
  const double root = std::sqrt(kMass), omega = std::sqrt(kStiffness / kMass);
  run->start(0.0, testing::vector(0.0), testing::vector(kSpeed * root));
  Impact found;
  while (run->state().time < 3.0 / omega) {
    run->step(3.0 / omega);
    const double exact = kSpeed / omega * std::sin(omega * run->state().time);
    found.error = std::max(found.error, kStiffness * std::abs(run->state().y(0) - exact));
  }
  found.steps = run->statistics().accepted;
  return found;
}

class Derived : public ::testing::TestWithParam<const Tableau*> {};
INSTANTIATE_TEST_SUITE_P(Methods, Derived, testing::all_methods(), testing::name_of_method);

TEST_P(Derived, AForceIsAsAccurateAsItWasAskedFor) {
  const Impact plain = impact(*GetParam(), {});
  Accuracy accuracy;
  accuracy.force_scale = 100.0;  // of a largest force of 4472 N
  const Impact asked = impact(*GetParam(), accuracy);
  const double limit = accuracy.tolerance * accuracy.force_scale;
  EXPECT_GT(plain.error, 20.0 * limit);
  EXPECT_LT(asked.error, 0.2 * plain.error);
  // A limit a step, of the force at once; what an error of the velocity does later adds to it.
  EXPECT_LT(asked.error, 5.0 * limit * static_cast<double>(asked.steps));
  EXPECT_GT(asked.steps, plain.steps);
}

TEST_P(Derived, TheAccelerationOfAMassIsItsForce) {
  Accuracy by_force, by_acceleration;
  by_force.force_scale = 100.0;
  by_acceleration.acceleration_scale = 100.0 / kMass;
  EXPECT_EQ(impact(*GetParam(), by_force).steps, impact(*GetParam(), by_acceleration).steps);
}

TEST(DerivedError, IsByHandWhatTheTangentMakesOfAnError) {
  System system;
  const int y = system.coordinate(system.add_body(testing::point_mass(kMass)), 0);
  system.add_element(std::make_unique<testing::Wall>(y, 0.0, kStiffness, 0.0, 1.0));
  Eigen::VectorXd f;
  system.evaluate({0.0, 1e-6, 1, {}}, testing::vector(1e-6), testing::vector(0.0), true, f);
  Accuracy accuracy;
  accuracy.force_scale = 10.0;
  EXPECT_NEAR(DerivedError(system, accuracy)
                  .measure(testing::vector(0.0), testing::vector(0.0), testing::vector(1e-9)),
              1.0 / 0.01, 1e-9);
  accuracy.force_scale = 0.0;
  EXPECT_EQ(DerivedError(system, accuracy)
                .measure(testing::vector(0.0), testing::vector(0.0), testing::vector(1e-9)),
            0.0);
  accuracy.acceleration_scale = 5.0;
  EXPECT_NEAR(DerivedError(system, accuracy)
                  .measure(testing::vector(0.0), testing::vector(0.0), testing::vector(1e-9)),
              0.5 / 0.005, 1e-9);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(
      std::isnan(DerivedError(system, accuracy)
                     .measure(testing::vector(0.0), testing::vector(0.0), testing::vector(nan))));
}

}  // namespace
}  // namespace clatter::dynamics
