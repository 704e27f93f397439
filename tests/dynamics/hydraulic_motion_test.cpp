// SPDX-License-Identifier: GPL-3.0-or-later
// Hydraulic elements in motion: given plunger motion against the reference, ports, energy.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/integrate/equilibrium.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/hydraulic_rig.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Ball = CheckValveSpec::Ball;
using testing::arbitrary;
using testing::equal_steps;
using testing::HydraulicRig;
using testing::kBar;
using testing::reference_tensioner;

TEST(Hydraulic, OracleASealedChamberIsASpringWithoutDrift) {
  ChamberSpec spec;
  spec.leak.height = 0.0;
  spec.valve.ball = Ball::kStuckShut;
  const double reference[][2] = {{0.1e-3, 5.27515}, {0.5e-3, 78.73396}};
  for (const auto& [pushed, bar] : reference) {
    // Pushed in and back a hundred times, then in.
    const double depth = pushed;
    HydraulicRig rig(spec, 3.5e5, 3.5e5, [depth](double t) {
      const double w = 201.0 * std::numbers::pi;
      return Motion<double>{-0.5 * depth * (1.0 - std::cos(w * t)),
                            -0.5 * depth * w * std::sin(w * t), 0.0};
    });
    rig.start(equal_steps(1e-4));
    rig.run_to(1.0);
    EXPECT_NEAR(rig.pressure() / kBar, bar, 5e-6);  // half of the last digit
  }
}

TEST(Hydraulic, OracleAPlungerPushedAtConstantSpeed) {
  HydraulicRig rig(reference_tensioner(), 3.5e5, 3.5e5, testing::steady(-0.05));
  rig.start(equal_steps(1e-6));
  rig.run_to(1e-3);
  EXPECT_NEAR(rig.pressure() / kBar, 4.15295, 5e-6);
  rig.run_to(5e-3);
  EXPECT_NEAR(rig.pressure() / kBar, 6.18762, 5e-6);
  // Later the modulus is so large that the pressure follows the leak.
  rig.run_to(0.2);
  EXPECT_NEAR(rig.pressure() / kBar, 6.722656, 5e-7);
}

/// -F/s of small motion, at the frequency, by the last of several periods.
std::complex<double> dynamic_stiffness(double frequency) {
  constexpr int kSteps = 2000;
  const double amplitude = 1e-7, w = 2.0 * std::numbers::pi * frequency;
  ChamberSpec spec = reference_tensioner();
  spec.valve.ball = Ball::kStuckShut;
  HydraulicRig rig(spec, 3.5e5, 3.5e5, testing::sine(amplitude, frequency));
  const double period = 1.0 / frequency;
  // Twelve relaxation times of 5.1 ms leave 6e-6 of the start.
  const int periods = static_cast<int>(std::ceil(0.062 * frequency)) + 1;
  auto options = equal_steps(period / kSteps);
  options.accuracy.tolerance = 1e-9;
  rig.start(options);
  rig.run_to((periods - 1) * period);
  std::complex<double> sum = 0.0;
  const double area = spec.area();
  for (int i = 1; i <= kSteps; ++i) {
    const double time = (periods - 1) * period + i * period / kSteps;
    rig.run_to(time);
    const double force = area * (rig.pressure() - 3.5e5);
    sum += -force * std::polar(1.0, -w * time);
  }
  // s = amplitude (e^iwt - e^-iwt) / 2i.
  return sum * std::complex<double>(0.0, 2.0 / (kSteps * amplitude));
}

TEST(Hydraulic, OracleSmallMotionHasTheStiffnessOfASpringAndADamperInSeries) {
  const double reference[][3] = {
      {10.0, 9281.42, 28816.97}, {85.0, 87127.57, 31825.15}, {1133.33, 98678.31, 2703.32}};
  for (const auto& [hz, real, imaginary] : reference) {
    const std::complex<double> K = dynamic_stiffness(hz);
    // Steps of a two-thousandth of a period: (2 pi / 2000)^2 / 12, and the motion's own 126 Pa.
    const double tolerance = 2e-5 * std::abs(K);
    EXPECT_NEAR(K.real(), real, tolerance) << hz;
    EXPECT_NEAR(K.imag(), imaginary, tolerance) << hz;
    RecordProperty("hz" + std::to_string(static_cast<int>(hz)),
                   std::to_string(K.real()) + " " + std::to_string(K.imag()));
  }
}

TEST(Hydraulic, ThePlungerIsFollowedUpToTheFlowOfTheValveAndCavitatesBeyond) {
  const ChamberSpec spec = reference_tensioner();
  const ChamberFluid oil = ChamberFluid::oil({});
  const double G = leak_conductance(spec.leak, spec.diameter, spec.oil.viscosity);
  const auto pressure = [&](double speed, double time) {
    HydraulicRig rig(spec, 3.5e5, 3.5e5, testing::steady(speed));
    rig.start(equal_steps(2e-6));
    rig.run_to(time);
    return rig.pressure();
  };
  // What comes in fills what the plunger leaves, at a constant pressure: by volumes up to 1.01244
  // m/s at 0 bar, but the supply's aerated oil expands on its way in.
  const double p = pressure(0.7, 0.02);
  const double followed = 1.01244 * std::sqrt(1.0 - p / 3.5e5) + G * (3.5e5 - p) / spec.area();
  EXPECT_NEAR(followed * oil.density(3.5e5) / oil.density(p), 0.7, 1e-3);
  EXPECT_GT(p, 1.5 * kBar);
  const double early = pressure(1.5, 0.02), late = pressure(1.5, 0.04);
  EXPECT_LT(early, 0.1 * kBar);
  EXPECT_LT(late, early);
  EXPECT_GT(late, 0.0);
}

/// A plunger in a planar body, or a node, as housing.
std::unique_ptr<HydraulicElement> element_between(std::unique_ptr<Port> housing,
                                                  std::unique_ptr<Port> plunger, Ball ball) {
  ChamberSpec spec;
  // Numbers of size 1, for difference quotients: the chamber is 1 m3 with a plunger of 1 m2.
  spec.diameter = 1.128379167;
  spec.volume = 4.0;
  spec.valve.ball = ball;
  spec.valve.seat_diameter = 0.1;
  spec.valve.contact_stiffness = 1e3;
  spec.valve.lift = 0.2;
  spec.leak.height = 1e-3;
  spec.outside = 1e5;
  const Chamber chamber(spec, [](double) { return 3.5e5; });
  PlungerAxis axis(std::move(housing), std::move(plunger), Vector3d(0.6, 0.0, 0.8), 0.1);
  std::vector<int> own{100};
  if (ball == Ball::kMoving) own.push_back(101);
  return std::make_unique<HydraulicElement>("tensioner", std::move(axis), chamber,
                                            PlungerSpring{90.0, 20.0}, HydraulicModel::kHydraulic,
                                            own, 0.0, 0.0);
}

std::unique_ptr<Port> planar(int first, const Eigen::Vector2d& arm) {
  const PlaneAxes plane{{0.1, 0.2, 0.3}, {0.6, 0.0, 0.8}, {0.0, 1.0, 0.0}};
  return std::make_unique<PlanarPort>(std::vector<int>{first, first + 1, first + 2}, arm, plane);
}

std::unique_ptr<Port> slide(int first) {
  return std::make_unique<SlidePort>(first, Vector3d(0.6, 0.0, 0.8), Vector3d(0.5, 0.1, 0.7),
                                     planar(first + 1, {0.2, -0.3}), Vector3d(0.5, 0.1, 0.7));
}

struct Variant {
  std::unique_ptr<HydraulicElement> element;
  int own = 1;
  double size = 0.5;  // of its coordinates
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  all.push_back({element_between(planar(0, {0.4, 0.1}), slide(3), Ball::kQuasiStatic), 1});
  all.push_back({element_between(planar(0, {0.4, 0.1}), slide(3), Ball::kMoving), 2});
  all.push_back({element_between(std::make_unique<GroundPort>(Vector3d(0.1, 0.2, 0.3)),
                                 planar(0, {0.4, 0.1}), Ball::kQuasiStatic),
                 1});
  // Rotations of a node are small ones.
  const Vector3d at(0.1, 0.2, 0.3), end(1.1, 0.4, 0.9);
  all.push_back(
      {element_between(std::make_unique<NodePort>(at, std::vector{0, 1, 2, 3, 4, 5}),
                       std::make_unique<NodePort>(end, std::vector{6, 7, 8}), Ball::kQuasiStatic),
       1, 1e-8});
  return all;
}

/// Arbitrary coordinates with the chamber near 3 bar.
VectorXd filled(HydraulicElement& element, int own, unsigned seed, double size = 0.5) {
  const auto n = static_cast<int>(element.coordinates().size());
  VectorXd y = size * arbitrary(n, seed);
  y(n - own) = 4000.0;
  if (own == 2) y(n - 1) = 0.05;
  Response response;
  element.evaluate({0.1, 0.03, 1, {0.03}}, y, VectorXd::Zero(n), false, response);
  element.finish_stage({0.1, 0.03, 1, {0.03}});
  element.accept_step(0.1);
  y(n - own) = 850.0 * 1.012 * element.accepted().chamber.volume;
  return y;
}

TEST(Hydraulic, TangentsAreTheDifferenceQuotientsOfTheForces) {
  for (const Variant& variant : variants()) {
    const VectorXd y = filled(*variant.element, variant.own, 5, variant.size);
    const VectorXd v = arbitrary(static_cast<int>(y.size()), 2);
    // Steps of 1e-6 on a pressure that changes by its modulus: third derivatives are 1e3 of it.
    EXPECT_LT(testing::tangent_error(*variant.element, y, v), 1e-7);
  }
}

TEST(Hydraulic, ForceAndMomentOfPlungerAndHousingBalance) {
  // Planar bodies: the sum of the forces on u and v, and the moment about the plane's origin.
  const auto element =
      element_between(planar(0, {0.4, 0.1}), planar(3, {0.2, -0.3}), Ball::kQuasiStatic);
  const VectorXd y = filled(*element, 1, 7);
  Response response;
  element->evaluate({0.1, 0.03, 1, {0.03}}, y, arbitrary(7, 3), false, response);
  const VectorXd& f = response.force;
  const double size = f.head(6).cwiseAbs().maxCoeff();
  EXPECT_GT(size, 1e3);
  EXPECT_NEAR(f(0) + f(3), 0.0, 1e-12 * size);
  EXPECT_NEAR(f(1) + f(4), 0.0, 1e-12 * size);
  const double moment = y(0) * f(1) - y(1) * f(0) + f(2) + y(3) * f(4) - y(4) * f(3) + f(5);
  EXPECT_NEAR(moment, 0.0, 1e-12 * size);
}

TEST(Hydraulic, TheForceDoesItsWorkOnTheTravel) {
  const auto element = element_between(planar(0, {0.4, 0.1}), slide(3), Ball::kQuasiStatic);
  const VectorXd y = filled(*element, 1, 9), v = arbitrary(8, 4);
  const Stage stage{0.1, 0.03, 1, {0.03}};
  Response response;
  const auto travel = [&](double h) {
    element->evaluate(stage, y + h * v, v, false, response);
    element->finish_stage(stage);
    return element->finished().travel;
  };
  const double rate = (travel(1e-6) - travel(-1e-6)) / 2e-6;
  travel(0.0);
  EXPECT_NEAR(response.force.head(7).dot(v.head(7)), element->finished().force * rate,
              1e-8 * element->finished().force);
}

TEST(SlidePort, FollowsItsGuideAcrossTheAxisAndItsOwnCoordinateAlongIt) {
  const auto port = slide(0);
  const Vector3d axis(0.6, 0.0, 0.8);
  const auto guide = planar(1, {0.2, -0.3});
  const VectorXd y = arbitrary(4, 1), v = arbitrary(4, 2);
  PortState at, of_guide;
  port->motion(0.0, y, v, at);
  guide->motion(0.0, y.tail(3), v.tail(3), of_guide);
  const Vector3d moved = at.position - Vector3d(0.5, 0.1, 0.7);
  EXPECT_NEAR(moved.dot(axis), y(0), 1e-15);
  EXPECT_NEAR(at.velocity.dot(axis), v(0), 1e-15);
  const Vector3d beside = moved - (of_guide.position - Vector3d(0.5, 0.1, 0.7));
  EXPECT_LT(beside.cross(axis).norm(), 1e-15);
  EXPECT_LT((at.velocity - of_guide.velocity).cross(axis).norm(), 1e-15);
  // Virtual work: a force across the axis acts on the guide alone, one along it on the body alone.
  Vector6 wrench = Vector6::Zero();
  wrench.head<3>() = axis;
  const VectorXd along = at.work.transpose() * wrench;
  EXPECT_NEAR(along(0), 1.0, 1e-15);
  EXPECT_LT(along.tail(3).norm(), 1e-15);
  wrench.head<3>() = Vector3d(-0.8, 2.0, 0.6);
  const VectorXd across = at.work.transpose() * wrench;
  EXPECT_NEAR(across(0), 0.0, 1e-15);
  EXPECT_LT((across.tail(3) - of_guide.work.transpose() * wrench).norm(), 1e-14);
}

TEST(Hydraulic, AtRestTheValveFeedsTheLeakAndSpringsBalanceThePressure) {
  testing::ShakenPlunger held(Ball::kQuasiStatic);
  VectorXd eta = held.system.eta_start();
  eta(0) += 1e-4 * std::sqrt(0.02);  // the plunger 0.1 mm out
  const Equilibrium rest = find_equilibrium(held.system, 0.0, eta);
  ASSERT_TRUE(rest.found) << rest.iterations << " " << rest.residual;
  held.system.finish_stage({0.0, 1.0, 1, {}});
  const HydraulicElement::Instant& at = held.element->finished();
  // 3.0 ml/s leak over 2.5 bar. The ball is open from 2 kPa on, where it passes 6.0 ml/s.
  EXPECT_LT(at.chamber.pressure.value, 3.5e5);
  EXPECT_GT(at.chamber.pressure.value, 3.48e5);
  EXPECT_NEAR(at.chamber.valve_flow, -at.chamber.leak_flow, 1e-3 * at.chamber.valve_flow);
  const double area = held.element->chamber().spec().area();
  // 1e5 N/m and 2000 N/m hold what the start has of 109.635 N.
  EXPECT_NEAR(at.travel, (90.0 + area * (at.chamber.pressure.value - 1e5) - 109.635) / 1.02e5,
              1e-10);
}

class ShakenTensioner : public ::testing::TestWithParam<Ball> {};
INSTANTIATE_TEST_SUITE_P(Hydraulic, ShakenTensioner,
                         ::testing::Values(Ball::kQuasiStatic, Ball::kMoving, Ball::kStuckOpen));

TEST_P(ShakenTensioner, ClosesItsEnergyBalanceTheBetterTheFinerTheTolerance) {
  double last = 1.0;
  for (const double tolerance : {1e-2, 1e-4}) {
    testing::ShakenPlunger shaken(GetParam());
    StepOptions options;
    options.largest = 1e-4;
    options.accuracy.tolerance = tolerance;
    const auto method = make_integrator(shaken.system, options);
    EnergyBalance energy(shaken.system, *options.method);
    method->set_observer(&energy);
    method->start(0.0, shaken.system.eta_start(), shaken.system.v_start());
    while (method->state().time < 0.05) method->step(0.05);
    EXPECT_GT(energy.now().lost, 1e-3);
    EXPECT_LT(energy.residue(), 0.3 * last);
    last = energy.residue();
  }
  EXPECT_LT(last, 1e-5);  // errors of steps, by the tolerance: the terms themselves balance
}

}  // namespace
}  // namespace clatter::dynamics
