// SPDX-License-Identifier: GPL-3.0-or-later
// A rigid piston without contact is a quadrature of known forces.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/run/model.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/motored_cycle.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

struct Crossing {
  double time = 0.0, speed = 0.0;
};

/// Time at which y first exceeds `gap`, between two accepted states: linear in v, so y is a
/// parabola.
Crossing crossing(const StageState& before, const StageState& now, int y, double gap) {
  double low = 0.0, high = 1.0;
  const double h = now.time - before.time;
  const auto position = [&](double s) {
    return before.y(y) + h * s * (before.v_y(y) + 0.5 * s * (now.v_y(y) - before.v_y(y)));
  };
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (position(middle) < gap ? low : high) = middle;
  }
  return {before.time + low * h, before.v_y(y) + low * (now.v_y(y) - before.v_y(y))};
}

TEST(RigidDryPiston, CrossesItsClearanceUnderARisingForceAsTabulated) {
  // m = 2 kg, F = k t with k = 2.89e6 N/s crosses the gap c in (6 m c / k)^(1/3).
  struct Row {
    double gap_um, ms, speed;
  };
  for (const Row row : {Row{5, .275, .055},
                        {10, .346, .087},
                        {20, .436, .138},
                        {50, .592, .253},
                        {100, .746, .402}}) {
    System system;
    const auto model = testing::rigid_piston(2.0, 4e-3, 9e-3);
    const int body = system.add_body(make_modal_body(model, {false, 0.0}));
    const int y = system.coordinate(body, 1);
    system.add_load({"side", body, system.bodies()[0].shapes.row(1).transpose(),
                     [](double t) { return 2.89e6 * std::max(t, 0.0); }});
    Dirk method(system, {});
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
    method.start(0.0, rest, rest);
    const double gap = row.gap_um * 1e-6;
    while (method.state().y(y) < gap) method.step(1.0);
    const Crossing at = crossing(method.previous(), method.state(), y, gap);
    EXPECT_NEAR(at.time * 1e3, row.ms, 0.01 * row.ms);
    EXPECT_NEAR(at.speed, row.speed, 0.01 * row.speed);
  }
}

/// Lateral motion of the pin on an exactly rigid slider-crank: one equation, from virtual power.
class ConstrainedPiston {
 public:
  ConstrainedPiston(const EngineSpec& engine, double piston_mass, double area,
                    const testing::MotoredCycle& cycle, double ambient)
      : engine_(engine),
        crank_(0.5 * engine.stroke, engine.rod.length, 0.0, engine.clock),
        mass_(piston_mass),
        area_(area),
        cycle_(cycle),
        ambient_(ambient) {}

  double acceleration(double t, double y, double v) const {
    const RodProperties& rod = engine_.rod;
    const auto c = crank_.crank_pin(t);
    const double l = rod.length, a = rod.centre / l;
    const double s = y - c.position.x(), s1 = v - c.velocity.x();
    const double r = std::sqrt(l * l - s * s), tau = s / r, tau1 = s1 * l * l / (r * r * r);
    const double y2c = c.acceleration.x(), z2c = c.acceleration.y();
    // Terms: coefficient of y'' and the rest, each multiplied by its virtual displacement.
    double coefficient = mass_ * (1.0 + tau * tau);
    double rest = -mass_ * tau * (z2c + tau * y2c - tau1 * s1);
    coefficient += rod.mass * a * a * (1.0 + tau * tau);
    rest += rod.mass * a *
            ((1.0 - a) * y2c - tau * ((1.0 - a) * z2c + a * (z2c + tau * y2c - tau1 * s1)));
    coefficient += rod.inertia / (r * r);
    rest += rod.inertia / r * (-y2c / r + s1 * s1 * s / (r * r * r));
    const double force = -area_ * (testing::motored_pressure(cycle_, crank_.angle(t)) - ambient_);
    return (-tau * force - rest) / coefficient;
  }

  /// Crossing of `gap` from rest at t = 0, by the classical Runge-Kutta method at 1 us.
  Crossing cross(double gap) const {
    double t = 0.0, y = 0.0, v = 0.0;
    const double h = 1e-6;
    while (y < gap) {
      const double k1 = acceleration(t, y, v);
      const double k2 = acceleration(t + h / 2, y + h / 2 * v, v + h / 2 * k1);
      const double k3 = acceleration(t + h / 2, y + h / 2 * v + h * h / 4 * k1, v + h / 2 * k2);
      const double k4 = acceleration(t + h, y + h * v + h * h / 2 * k2, v + h * k3);
      y += h * v + h * h / 6 * (k1 + k2 + k3);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      t += h;
    }
    return {t, v};
  }

 private:
  EngineSpec engine_;
  SliderCrank crank_;
  double mass_, area_;
  testing::MotoredCycle cycle_;
  double ambient_;
};

TEST(RigidDryPiston, MovesOnTheSamplesRodAndGasLikeTheConstrainedMechanism) {
  Scene scene;
  scene.clock = CrankClock{2000.0 * std::numbers::pi / 30.0};
  CylinderSpec cylinder;
  cylinder.engine = EngineSpec{{0.130, 0.0, false, Rotation::kForward, {}},
                               *scene.clock,
                               RodProperties{0.210, 2.2, 0.02, 0.07},
                               0.0,
                               {}};
  PistonSpec& piston = cylinder.piston;
  piston.name = "piston";
  piston.elastic = false;
  const testing::MotoredCycle cycle;
  GasSpec gas;
  gas.table = ::testing::TempDir() + "clatter_dry_piston.csv";
  testing::write_motored_cycle(gas.table, cycle, std::numbers::pi / 720.0);
  cylinder.gas = gas;
  // Nearly rigid joints without clearance: 40 kN press 1e11 N/m by 0.4 um.
  cylinder.small_end.law = cylinder.big_end.law = RadialLaw{0.0, 0.0, 1e11, 1.0, 3e5};
  scene.components = {std::make_shared<CylinderComponent>(cylinder)};
  const double area = 8.992e-3;
  LoadedBodies bodies;
  bodies.push_back(make_loaded_body(piston, testing::rigid_piston(1.916, 4e-3, area)));

  for (const double gap : {20e-6, 50e-6, 100e-6}) {
    const auto model = build_model(scene, bodies);
    const int pin_y = components_of<CylinderComponent>(*model).at(0)->pin()[1];
    Dirk method(model->system, {});
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model->system.modes());
    method.start(0.0, rest, rest);
    while (method.state().y(pin_y) < gap) method.step(0.01);
    const Crossing found = crossing(method.previous(), method.state(), pin_y, gap);
    const Crossing exact = ConstrainedPiston(cylinder.engine, 1.916, area, cycle, 1e5).cross(gap);
    EXPECT_NEAR(found.time, exact.time, 0.01 * exact.time) << gap;
    EXPECT_NEAR(found.speed, exact.speed, 0.01 * exact.speed) << gap;
  }
}

}  // namespace
}  // namespace clatter::dynamics
