// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/hydraulic_rig.hpp"

#include <cmath>
#include <numbers>

#include "dynamics/body/rigid_body.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"

namespace clatter::dynamics::testing {

using Eigen::Vector3d;

void GivenPort::motion(double time, const Eigen::VectorXd&, const Eigen::VectorXd&,
                       PortState& state) {
  const Motion<double> at = motion_(time);
  state.clear(0);
  state.position = at.position * axis_;
  state.velocity = at.velocity * axis_;
  state.driven.head<3>() = state.velocity;
}

ChamberSpec reference_tensioner() {
  ChamberSpec spec;
  spec.leak.to_supply = true;
  return spec;
}

HydraulicRig::HydraulicRig(const ChamberSpec& spec, double pressure, double supply,
                           const GivenMotion& motion) {
  const Chamber chamber(spec, [supply](double) { return supply; });
  const double travel = motion(0.0).position;
  const int body = system.add_body(make_chamber_body("chamber", chamber, 0.0, travel, pressure));
  std::vector<int> own{system.coordinate(body, 0)};
  if (chamber.valve().has_moving_ball()) own.push_back(system.coordinate(body, 1));
  PlungerAxis axis(std::make_unique<GroundPort>(Vector3d::Zero()),
                   std::make_unique<GivenPort>(Vector3d::UnitX(), motion), Vector3d::UnitX(), 0.0);
  auto made = std::make_unique<HydraulicElement>("tensioner", std::move(axis), chamber,
                                                 PlungerSpring{90.0, 2000.0},
                                                 HydraulicModel::kHydraulic, own, travel, 0.0);
  element = made.get();
  system.add_element(std::move(made));
}

void HydraulicRig::start(const StepOptions& options) {
  method = make_integrator(system, options);
  method->start(-options.first, system.eta_start(), system.v_start());
}

void HydraulicRig::run_to(double time) {
  while (method->state().time < time * (1.0 - 1e-12)) method->step(time);
}

ShakenPlunger::ShakenPlunger(CheckValveSpec::Ball ball) {
  const int plunger = system.add_body(make_sliding_body("plunger", 0.02, Vector3d::UnitX(), 0.0));
  const int s = system.coordinate(plunger, 0);
  ChamberSpec spec;
  spec.valve.ball = ball;
  spec.relief = {12e5, 1e-11};
  const Chamber chamber(spec, [](double) { return 3.5e5; });
  const int body = system.add_body(make_chamber_body("chamber", chamber, 0.0, 0.0, 3.5e5, 1e4));
  std::vector<int> own{system.coordinate(body, 0)};
  if (ball == CheckValveSpec::Ball::kMoving) own.push_back(system.coordinate(body, 1));
  const auto port = [&] {
    return std::make_unique<SlidePort>(s, Vector3d::UnitX(), Vector3d::Zero(),
                                       std::make_unique<GroundPort>(Vector3d::Zero()),
                                       Vector3d::Zero());
  };
  PlungerAxis axis(std::make_unique<GroundPort>(Vector3d(-0.01, 0.0, 0.0)), port(),
                   Vector3d::UnitX(), 0.01);
  auto made = std::make_unique<HydraulicElement>("tensioner", std::move(axis), chamber,
                                                 PlungerSpring{90.0, 2000.0},
                                                 HydraulicModel::kHydraulic, own, 0.0, 0.0);
  element = made.get();
  system.add_element(std::move(made));
  // Without force at the start: 109.6 N of the tensioner on 1e5 N/m.
  system.add_element(std::make_unique<PairElement>(
      "chain", port(), std::make_unique<GroundPort>(Vector3d(0.1, 0.0, 0.0)),
      std::make_unique<LineSpring>(1e5, 5.0, 0.1 + 109.635e-5)));
  system.add_load({"shake", plunger, system.bodies()[0].shapes.row(0).transpose(),
                   [](double t) { return 80.0 * std::sin(2.0 * std::numbers::pi * 85.0 * t); }});
}

StepOptions equal_steps(double dt, const Tableau* method) {
  StepOptions options;
  options.method = method;
  options.largest = dt;
  options.first = 1e-12;  // its implicit Euler stage is of first order: too short to be seen
  options.fixed = true;
  options.accuracy.tolerance = 1e-6;
  return options;
}

GivenMotion steady(double speed) {
  return [speed](double t) {
    return t > 0.0 ? Motion<double>{speed * t, speed, 0.0} : Motion<double>{0.0, 0.0, 0.0};
  };
}

GivenMotion sine(double amplitude, double frequency) {
  return [=](double t) {
    const double w = 2.0 * std::numbers::pi * frequency;
    return Motion<double>{amplitude * std::sin(w * t), amplitude * w * std::cos(w * t),
                          -amplitude * w * w * std::sin(w * t)};
  };
}

void OilBalance::stage(int index, const StageState&) {
  inflow_[index] = element_.finished().chamber.inflow.value;
  if (first_ < 0.0) first_ = element_.finished().content;
}

void OilBalance::accept(double dt) {
  for (int i = 0; i <= method_.stages; ++i) {
    came_in_ += dt * method_.b[i] * inflow_[i];
    exchanged_ += dt * std::abs(method_.b[i] * inflow_[i]);
  }
  inflow_[0] = inflow_[method_.stages];
}

double OilBalance::residue() const {
  return std::abs(came_in_ - (element_.finished().content - first_)) / exchanged_;
}

}  // namespace clatter::dynamics::testing
