// SPDX-License-Identifier: GPL-3.0-or-later
// Coil springs as masses: wire, surge frequencies, clash of coils, tangent.
#include "dynamics/valve/coil_spring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/shaft_model.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<int> add_coils(System& system, const CoilSpringSpec& spec) {
  const int body = system.add_body(make_coil_body("coils", spec, Vector3d::UnitX(), {}));
  std::vector<int> masses;
  for (int k = 0; k < spec.masses; ++k) masses.push_back(system.coordinate(body, k));
  return masses;
}

CoilEnd ground(double x) {
  const Vector3d at(x, 0.0, 0.0);
  return {std::make_unique<GroundPort>(at), Vector3d::UnitX(), at};
}

TEST(CoilSpring, OracleStiffnessMassAndSurgeFollowFromTheWire) {
  const CoilSpringSpec spec;
  EXPECT_NEAR(spec.stiffness, 22214.28, 0.005);
  EXPECT_NEAR(spec.mass, 28.88398e-3, 6e-9);  // 28.883975 g
  EXPECT_NEAR(spec.surge(), 438.4879, 5e-5);
  std::printf("%.2f N/m, %.5f g, %.4f Hz\n", spec.stiffness, 1e3 * spec.mass, spec.surge());
}

TEST(CoilSpring, OracleLumpsHaveTheFrequenciesOfTheirFormula) {
  for (const auto& [masses, reference] : {std::pair{4, 427.304}, {8, 435.676}}) {
    CoilSpringSpec spec;
    spec.masses = masses;
    System system;
    const std::vector<int> y = add_coils(system, spec);
    system.add_element(std::make_unique<CoilSpring>("spring", ground(0.0), ground(0.04), y, spec));
    const VectorXd found = testing::frequencies(system, 0);
    const double angle = 0.5 * std::numbers::pi / masses;
    EXPECT_NEAR(found(0), reference, 5e-4);
    // Of the whole series: sin(k pi / 2n) of the continuous spring's.
    for (int k = 1; k < masses; ++k)
      EXPECT_NEAR(found(k - 1), spec.surge() * std::sin(k * angle) / angle, 1e-9 * found(k - 1));
    std::printf("%d masses: %.3f Hz\n", masses, found(0));
  }
}

TEST(CoilSpring, PressedSlowlyItHasTheStiffnessOfTheWire) {
  CoilSpringSpec spec;
  double compliance = 0.0, gap = 0.0;
  for (const CoilLaw& law : coil_laws(spec)) {
    compliance += 1.0 / law.stiffness();
    gap += law.gap();
  }
  EXPECT_NEAR(1.0 / compliance, spec.stiffness, 1e-10 * spec.stiffness);
  EXPECT_NEAR(gap, spec.to_solid, 1e-15);
}

/// Two of eight masses of the spring, which meet with 1 m/s and have no wire between them.
struct Clash {
  double restitution = 0.0, time = 0.0;
};

Clash clash(double ratio) {
  CoilSpringSpec spec;
  spec.mass /= 4.0;
  spec.masses = 2;
  spec.stiffness = 1e-9;
  spec.force = 0.0;
  spec.damping = 0.0;
  spec.clash_stiffness = 1e7;
  spec.clash_damping = ratio;
  System system;
  ModalBody body = make_coil_body("coils", spec, Vector3d::UnitX(), {});
  const double start = 1e-6;  // before the coils touch [m]
  const double gap = spec.to_solid / spec.masses;
  body.eta_start << 0.5 * (gap - start) / body.shapes(0, 0),
      -0.5 * (gap - start) / body.shapes(0, 0);
  body.v_start << 0.5 / body.shapes(0, 0), -0.5 / body.shapes(0, 0);
  const int index = system.add_body(body);
  const std::vector<int> y{system.coordinate(index, 0), system.coordinate(index, 1)};
  system.add_element(std::make_unique<CoilSpring>("spring", ground(0.0), ground(0.04), y, spec));
  StepOptions options;
  options.accuracy.tolerance = 1e-5;
  options.largest = 1e-7;
  const auto method = testing::started(system, options);
  double begin = -1.0, end = -1.0;
  // Where the gap is 0, on a line through the ends of a step: they are short.
  double before = start, t_before = method->state().time;
  while (method->state().time < 80e-6) {
    method->step(80e-6);
    const auto& now = method->state();
    const double left = now.y(y[1]) - now.y(y[0]) + gap;
    const double t = t_before + (now.time - t_before) * before / (before - left);
    if (before > 0.0 && left <= 0.0) begin = t;
    if (before <= 0.0 && left > 0.0) end = t;
    before = left;
    t_before = now.time;
  }
  const auto& v = method->state().v_y;
  EXPECT_NEAR(v(y[0]) + v(y[1]), 0.0, 1e-12);
  return {v(y[1]) - v(y[0]), end - begin};
}

TEST(CoilSpring, OracleCoilsThatClashBounceByTheirDamping) {
  for (const auto& [ratio, reference] : {std::pair{0.0, 1.0}, {0.1, 0.744079}, {0.2, 0.571740}}) {
    const Clash found = clash(ratio);
    // The smooth begin of the damping, over 0.1 um of 13, gives some 1e-3 back.
    EXPECT_NEAR(found.restitution, reference, ratio == 0.0 ? 2e-5 : 2e-3);
    if (ratio == 0.0) {
      EXPECT_NEAR(found.time, 42.2103e-6, 2e-10);
    }
    std::printf("zeta %.1f: e %.6f (%.6f), %.4f us\n", ratio, found.restitution, reference,
                1e6 * found.time);
  }
}

TEST(CoilSpring, TheTangentIsTheDerivativeOfTheForce) {
  CoilSpringSpec spec;
  spec.masses = 3;
  System system;
  const std::vector<int> a =
      testing::add_planar(system, "a", 1.0, 1.0, {Vector2d(-0.01, 0.0), 0.2, {}, 0.0});
  const std::vector<int> b =
      testing::add_planar(system, "b", 1.0, 1.0, {Vector2d(0.05, 0.0), 0.1, {}, 0.0});
  const std::vector<int> y = add_coils(system, spec);
  CoilEnd left(std::make_unique<PlanarPort>(a, Vector2d(0.01, 0.002)), Vector3d::UnitX(),
               Vector3d::Zero());
  CoilEnd right(std::make_unique<PlanarPort>(b, Vector2d(-0.01, 0.003)), Vector3d::UnitX(),
                Vector3d(0.04, 0.0, 0.0));
  CoilSpring spring("spring", std::move(left), std::move(right), y, spec);
  for (const double squeeze : {0.0, 8.9e-3, -9e-3}) {  // installed, coils touch, ends without force
    VectorXd at = 1e-3 * testing::arbitrary(9, 7), rate = testing::arbitrary(9, 8);
    at(0) -= 0.01;
    at(2) = 0.2;
    at(6) += 0.05 - squeeze;
    at(8) = 0.1;
    for (int k = 0; k < 3; ++k) at(3 + k) -= squeeze * (k + 0.5) / 3.0;
    EXPECT_LT(testing::tangent_error(spring, at, rate, 1e-9), 2e-6) << squeeze;
  }
}

TEST(CoilSpring, WhatActsOnEndsAndMassesSumsUpToZero) {
  CoilSpringSpec spec;
  System system;
  const std::vector<int> a = testing::add_planar(system, "a", 1.0, 1.0, {}),
                         b = testing::add_planar(system, "b", 1.0, 1.0, {});
  const std::vector<int> y = add_coils(system, spec);
  CoilSpring spring(
      "spring",
      {std::make_unique<PlanarPort>(a, Vector2d(0.0, 0.01)), Vector3d::UnitX(), Vector3d::Zero()},
      {std::make_unique<PlanarPort>(b, Vector2d(0.0, 0.02)), Vector3d::UnitX(), Vector3d::Zero()},
      y, spec);
  Response response;
  const VectorXd at = 2e-3 * testing::arbitrary(14, 3), rate = testing::arbitrary(14, 4);
  spring.evaluate({0.0, 1e-5, 1, {}}, at, rate, false, response);
  double along = response.force(0) + response.force(11);
  for (int k = 3; k < 11; ++k) along += response.force(k);
  EXPECT_NEAR(along, 0.0, 1e-12 * response.force.cwiseAbs().maxCoeff());
  EXPECT_EQ(response.force(1), 0.0);
  EXPECT_EQ(response.force(12), 0.0);
}

}  // namespace
}  // namespace clatter::dynamics
