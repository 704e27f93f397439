// SPDX-License-Identifier: GPL-3.0-or-later
// engine.balanced: the block's rigid modes get no resultant of the mechanism's inertia.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/dense/solve.hpp"
#include "tests/dynamics/synthetic_engine.hpp"

namespace clatter::dynamics {
namespace {

using testing::EngineVariant;
using testing::SyntheticEngine;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr const char* kBalance = "balance of the other cylinders";

/// Forces of the exactly rigid mechanism on the block, about the engine's origin, by the equations
/// of Newton and Euler for piston (centre of mass on the pin) and rod: bearings and side force.
Vector6 reactions(const EngineSpec& engine, const SliderCrank& crank, double mass, double x,
                  double t) {
  const RodProperties& rod = engine.rod;
  const auto pin = crank.piston_pin(t);
  const auto centre = crank.rod_point(t, rod.centre);
  const Eigen::Vector2d small = crank.rod_point(t, rod.length).position - centre.position;
  const Eigen::Vector2d big = crank.crank_pin(t).position - centre.position;
  // Unknown: lateral force of the pin on the rod and force (y, z) of the crank on the rod.
  const double stroke = -mass * pin.acceleration;  // of the pin on the rod
  Eigen::Matrix3d A;
  Eigen::Vector3d b;
  A << 1.0, 1.0, 0.0,  //
      0.0, 0.0, 1.0,   //
      -small.y(), -big.y(), big.x();
  b << rod.mass * centre.acceleration.x(), rod.mass * centre.acceleration.y() - stroke,
      rod.inertia * crank.rod_angle(t).acceleration - small.x() * stroke;
  const Eigen::Vector3d f = dense::solve(A, b);
  const Eigen::Vector3d bearing(0.0, -f(1), -f(2));
  const Eigen::Vector3d side(0.0, -f(0), 0.0);  // through the piston, at the pin's height
  Vector6 on_block;
  on_block << bearing + side, Eigen::Vector3d(x, 0.0, 0.0).cross(bearing) +
                                  Eigen::Vector3d(x, engine.pin_offset, pin.position).cross(side);
  return on_block;
}

/// Resultant of a load on its body, about the body's origin.
Vector6 resultant(const Model& model, const Load& load, double t) {
  const ModalBody& body = model.system.bodies()[load.body];
  return body.rigid.transpose() * load.direction * load.value(t);
}

// Before, the roll moment was cancelled without the part that the crank's drive does not hold: 334
// of 346 N m remained at 2000 rpm.
TEST(Balanced, LeavesNoInertiaResultantOfTheRigidMechanismOnTheBlock) {
  for (const double offset : {0.0, 1e-3}) {
    const SyntheticEngine engine(
        {.name = "", .elastic_piston = false, .balanced = true, .pin_offset = offset});
    const auto model = engine.model();
    const EngineSpec& spec = engine.cylinder.engine;
    const double mass = engine.bodies[0].model.mass.mass;
    const double x = engine.bodies[1].model.grid("liner_4").axis_point.x();
    Vector6 largest = Vector6::Zero(), left = Vector6::Zero();
    for (int degrees = -360; degrees < 360; degrees += 7) {
      const double t = degrees * std::numbers::pi / 180.0 / spec.clock.speed;
      const Vector6 on_block = reactions(spec, testing::cylinder_of(*model).crank(), mass, x, t);
      Vector6 sum = on_block;
      for (const Load& load : model->system.loads())
        if (load.term == kBalance) sum += resultant(*model, load, t);
      largest = largest.cwiseMax(on_block.cwiseAbs());
      left = left.cwiseMax(sum.cwiseAbs());
    }
    std::printf(
        "inertia on the block at offset %.1f mm: forces %.0f, %.0f N, moments %.0f, %.0f, "
        "%.0f N m; balanced: %.1e, %.1e N, %.1e, %.1e, %.1e N m\n",
        1e3 * offset, largest(1), largest(2), largest(3), largest(4), largest(5), left(1), left(2),
        left(3), left(4), left(5));
    EXPECT_GT(largest(3), 300.0);
    EXPECT_LT(left.head<3>().maxCoeff(), 1e-11 * largest.head<3>().maxCoeff());
    EXPECT_LT(left.tail<3>().maxCoeff(), 1e-11 * largest.tail<3>().maxCoeff());
  }
}

// The same for an elastic piston whose centre of mass is off the pin, without the mechanism's
// forces: all loads of the system and the drive's torque have no resultant.
TEST(Balanced, HoldsForAPistonWhoseMassIsOffThePin) {
  const SyntheticEngine engine({.name = "", .balanced = true, .pin_offset = 1.2e-3});
  const auto model = engine.model();
  const SliderCrank& crank = testing::cylinder_of(*model).crank();
  const RodProperties& rod = engine.cylinder.engine.rod;
  const double x = engine.bodies[1].model.grid("liner_4").axis_point.x();
  for (const double t : {-0.011, -0.002, 0.0, 0.0013, 0.0041}) {
    const auto pin = crank.piston_pin(t);
    const auto centre = crank.rod_point(t, rod.centre);
    Vector6 sum = Vector6::Zero();
    double size = 0.0, mass = 0.0;
    for (const Load& load : model->system.loads()) {
      const std::string& body = model->system.bodies()[load.body].name;
      Vector6 one = resultant(*model, load, t);
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      if (body == "piston") {
        place = {x, crank.pin_offset(), pin.position};
        mass = -one(2) / pin.acceleration;
      }
      if (body == "rod") place = {x, centre.position.x(), centre.position.y()};
      one.tail<3>() += place.cross(one.head<3>());
      sum += one;
      size = std::max(size, one.cwiseAbs().maxCoeff());
    }
    const double power =
        mass * pin.acceleration * pin.velocity +
        rod.mass * centre.acceleration.dot(centre.velocity) +
        rod.inertia * crank.rod_angle(t).acceleration * crank.rod_angle(t).velocity;
    sum(3) += power / crank.spin(t);
    EXPECT_LT(sum.cwiseAbs().maxCoeff(), 1e-11 * size) << t;
  }
}

TEST(Balanced, LeavesTheElasticModesAlone) {
  const SyntheticEngine engine({.name = "", .balanced = true});
  const auto model = engine.model();
  int loads = 0;
  for (const Load& load : model->system.loads()) {
    if (load.term != kBalance) continue;
    ++loads;
    const auto elastic = load.direction.tail(load.direction.size() - 6);
    EXPECT_LT(elastic.cwiseAbs().maxCoeff(), 1e-10 * load.direction.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(loads, 0);
}

}  // namespace
}  // namespace clatter::dynamics
