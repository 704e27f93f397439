// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases of rigid contacts: accumulation, simultaneous events, very many impacts.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/element/stop.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;
using testing::started;

RigidStop* add_stop(System& system, std::unique_ptr<Port> point, const Vector3d& on_plane,
                    const Vector3d& normal, double restitution) {
  auto stop = std::make_unique<RigidStop>(
      "wall", PointOnPlane(std::move(point), std::make_unique<GroundPort>(on_plane), normal),
      restitution, 1e8, FrictionLaw{});
  RigidStop* kept = stop.get();
  system.add_element(std::move(stop));
  return kept;
}

StepOptions options_with(double tolerance) {
  StepOptions options;
  options.largest = 1e-3;
  options.first = 1e-9;
  options.accuracy = {tolerance, 1e-3, 0.1, 0.05};
  return options;
}

void add_weight(System& system, int body, double mass) {
  system.add_load(
      {"weight", body, Eigen::Vector3d(std::sqrt(mass), 0.0, 0.0), [](double) { return -9.81; }});
}

TEST(HardTD3_ChatteringAndZeno, ABlockThatRocksOnTwoFeetComesToRestWithAllOfItsMomentum) {
  // A block falls on one foot first; impacts alternate between the feet and accumulate on both.
  const double mass = 2.0, moment = 0.01, half = 0.1, end = 0.4;
  for (const double e : {0.3, 0.6}) {
    System system;
    PlanarMotion start;
    start.centre = {2e-3, 0.0};
    start.angle = 4e-3;
    const auto y = testing::add_planar(system, "block", mass, moment, start);
    add_weight(system, 0, mass);
    RigidStop* feet[2];
    for (int k = 0; k < 2; ++k)
      feet[k] = add_stop(
          system, std::make_unique<PlanarPort>(y, Eigen::Vector2d(0.0, k == 0 ? half : -half)),
          Vector3d::Zero(), Vector3d::UnitX(), e);
    EnergyBalance energy(system);
    const auto method = make_integrator(system, options_with(1e-6));
    method->set_observer(&energy);
    method->start(-1e-9, system.eta_start(), system.v_start());
    while (method->state().time < end) method->step(end);
    for (const RigidStop* foot : feet) EXPECT_TRUE(foot->is_held());
    // The last two steps to an event share what is left.
    EXPECT_GT(method->statistics().smallest_step, 0.49 * options_with(1e-6).smallest);
    const auto& state = method->state();
    EXPECT_NEAR(state.y(y[0]), -0.5 * mass * 9.81 / 1e8, 1e-10);
    EXPECT_NEAR(state.y(y[2]), 0.0, 1e-9);
    EXPECT_NEAR(state.v_y(y[0]), 0.0, 1e-9);
    EXPECT_LT(method->statistics().accepted, 20000);
    test::expect_at_most("energy residue of a rocking block", energy.residue(), 1e-6);
    std::printf("e %.1f: %lld events, %lld steps, shortest %.1e s\n", e,
                method->statistics().events, method->statistics().accepted,
                method->statistics().smallest_step);
  }
}

TEST(HardTD4_EventsThatCoincide, ABlockThatFallsFlatOnTwoFeetIsHitByBothAtOnce) {
  // Both feet reach the ground in the same instant: the block neither turns nor sinks.
  const double mass = 2.0, moment = 0.01, half = 0.1, end = 0.4;
  System system;
  PlanarMotion start;
  start.centre = {1e-3, 0.0};
  const auto y = testing::add_planar(system, "block", mass, moment, start);
  add_weight(system, 0, mass);
  for (const double side : {half, -half})
    add_stop(system, std::make_unique<PlanarPort>(y, Eigen::Vector2d(0.0, side)), Vector3d::Zero(),
             Vector3d::UnitX(), 0.5);
  const auto method = started(system, options_with(1e-6));
  double lowest = 1.0;
  while (method->state().time < end) {
    method->step(end);
    const auto& at = method->state().y;
    lowest = std::min(lowest, at(y[0]) - half * std::abs(std::sin(at(y[2]))));
  }
  test::expect_at_least("deepest position [m]", lowest, -1e-6);
  EXPECT_NEAR(method->state().y(y[0]), -0.5 * mass * 9.81 / 1e8, 1e-10);
  EXPECT_NEAR(method->state().v_y(y[2]), 0.0, 1e-8);
}

TEST(HardTD4_EventsThatCoincide, TwoBallsThatLandInOneStepBothBounce) {
  const double end = 0.03;
  for (const double delay : {1e-6, 0.0}) {
    System system;
    RigidStop* floors[2];
    std::vector<int> y[2];
    double landing[2];
    for (int k = 0; k < 2; ++k) {
      landing[k] = 0.02 + k * delay;
      PlanarMotion start;
      start.centre = {0.5 * 9.81 * landing[k] * landing[k], 0.0};
      y[k] = testing::add_planar(system, "ball", 1.0, 1.0, start);
      add_weight(system, k, 1.0);
      floors[k] = add_stop(system, std::make_unique<PlanarPort>(y[k], Eigen::Vector2d::Zero()),
                           Vector3d::Zero(), Vector3d::UnitX(), 1.0);
    }
    const auto method = started(system, options_with(1e-6));
    while (method->state().time < end) method->step(end);
    EXPECT_EQ(method->statistics().events, 2);
    for (int k = 0; k < 2; ++k) {
      EXPECT_FALSE(floors[k]->is_held());
      EXPECT_NEAR(method->state().v_y(y[k][0]), 9.81 * (2.0 * landing[k] - end), 1e-6) << k;
    }
  }
}

TEST(HardTD4_EventsThatCoincide, AnImpactAtTheEndOfAStepIsTakenOnce) {
  // Without weight the ball meets the wall after exactly four steps.
  System system;
  PlanarMotion start;
  start.centre = {0.5, 0.0};
  start.velocity = {-1.0, 0.0};
  const auto y = testing::add_planar(system, "ball", 1.0, 1.0, start);
  add_stop(system, std::make_unique<PlanarPort>(y, Eigen::Vector2d::Zero()), Vector3d::Zero(),
           Vector3d::UnitX(), 0.5);
  StepOptions options = options_with(1e-6);
  options.largest = 0.125;
  options.first = 1e-12;
  options.fixed = true;
  const auto method = started(system, options);
  while (method->state().time < 1.0) method->step(1.0);
  EXPECT_EQ(method->statistics().events, 1);
  test::expect_at_most("error of the position after an impact at the end of a step [m]",
                       std::abs(method->state().y(y[0]) - 0.25), 1e-9);
  EXPECT_NEAR(method->state().v_y(y[0]), 0.5, 1e-12);
}

TEST(HardTD4_EventsThatCoincide, ABallThatStartsOnItsFloorIsHeldThere) {
  System system;
  const auto y = testing::add_planar(system, "ball", 3.0, 1.0, {});
  add_weight(system, 0, 3.0);
  RigidStop* floor = add_stop(system, std::make_unique<PlanarPort>(y, Eigen::Vector2d::Zero()),
                              Vector3d::Zero(), Vector3d::UnitX(), 0.9);
  const auto method = started(system, options_with(1e-6));
  while (method->state().time < 0.1) method->step(0.1);
  EXPECT_TRUE(floor->is_held());
  EXPECT_NEAR(method->state().y(y[0]), -3.0 * 9.81 / 1e8, 1e-11);
}

TEST(HardTD3_ChatteringAndZeno, TenThousandElasticImpactsKeepTheEnergyAndTheRhythm) {
  // Between two walls 2 mm apart, at 1 m/s: an impact every 2 ms.
  System system;
  PlanarMotion start;
  start.velocity = {1.0, 0.0};
  const auto y = testing::add_planar(system, "ball", 0.7, 1.0, start);
  for (const double side : {1.0, -1.0})
    add_stop(system, std::make_unique<PlanarPort>(y, Eigen::Vector2d::Zero()),
             Vector3d(side * 1e-3, 0.0, 0.0), -side * Vector3d::UnitX(), 1.0);
  const auto method = started(system, options_with(1e-6));
  const double end = 20.0 + 0.5e-3;
  while (method->state().time < end) method->step(end);
  EXPECT_EQ(method->statistics().events, 10000);
  test::expect_at_most("error of the speed after ten thousand impacts [m/s]",
                       std::abs(std::abs(method->state().v_y(y[0])) - 1.0), 1e-10);
  EXPECT_NEAR(method->state().y(y[0]), 0.5e-3, 1e-8);
}

TEST(RigidStop, ResumesItsModeAndItsSum) {
  const auto make = [](System& system) {
    PlanarMotion start;
    start.centre = {1e-3, 0.0};
    const auto y = testing::add_planar(system, "ball", 1.0, 1.0, start);
    add_weight(system, 0, 1.0);
    return add_stop(system, std::make_unique<PlanarPort>(y, Eigen::Vector2d::Zero()),
                    Vector3d::Zero(), Vector3d::UnitX(), 0.5);
  };
  System one, other;
  make(one);
  make(other);
  for (const double until : {0.03, 0.06}) {  // between two impacts, and at rest
    const auto method = started(one, options_with(1e-6));
    while (method->state().time < until) method->step(until);
    const auto saved = one.element(0).save();
    const StageState state = method->state();
    const int rung = method->rung();
    method->forget_history();
    while (method->state().time < 0.1) method->step(0.1);
    other.element(0).restore(saved);
    const auto resumed = make_integrator(other, options_with(1e-6));
    resumed->resume(state, rung);
    while (resumed->state().time < 0.1) resumed->step(0.1);
    EXPECT_EQ(resumed->state().eta, method->state().eta);
    EXPECT_EQ(resumed->state().v, method->state().v);
    one.element(0).restore({0.0, 0.0, 0.0});
  }
  EXPECT_THROW(other.element(0).restore({1.0}), InputError);
}

TEST(RigidStop, ResumesWhatSticks) {
  // A block that slides to a stop on its floor while it bounces, held by a spring.
  const auto make = [](System& system) {
    PlanarMotion start;
    start.centre = {1e-3, 0.0};
    start.velocity = {0.0, 0.05};
    const auto y = testing::add_planar(system, "block", 1.0, 1.0, start);
    add_weight(system, 0, 1.0);
    system.add_element(std::make_unique<RigidStop>(
        "floor",
        PointOnPlane(std::make_unique<PlanarPort>(y, Eigen::Vector2d::Zero()),
                     std::make_unique<GroundPort>(Vector3d::Zero()), Vector3d::UnitX()),
        0.3, 1e8, FrictionLaw{0.2, 0.3, {}, 1e7, 1e-4}));
  };
  for (const double until : {0.02, 0.03, 0.05}) {
    System one, other;
    make(one);
    make(other);
    const auto method = started(one, options_with(1e-6));
    while (method->state().time < until) method->step(until);
    other.element(0).restore(one.element(0).save());
    const auto resumed = make_integrator(other, options_with(1e-6));
    resumed->resume(method->state(), method->rung());
    method->forget_history();
    for (Integrator* each : {method.get(), resumed.get()})
      while (each->state().time < 0.1) each->step(0.1);
    EXPECT_EQ(resumed->state().eta, method->state().eta) << until;
    EXPECT_EQ(resumed->state().v, method->state().v) << until;
    EXPECT_LT(method->state().v.norm(), 1e-6) << until;
  }
}

}  // namespace
}  // namespace clatter::dynamics
