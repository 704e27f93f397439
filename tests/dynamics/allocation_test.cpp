// SPDX-License-Identifier: GPL-3.0-or-later
// The step loop takes no memory: every allocation of the program is counted.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/base/threads.hpp"
#include "dynamics/element/stop.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "dynamics/profile/mattress.hpp"
#include "dynamics/profile/tooth_gap.hpp"
#include "dynamics/run/start_state.hpp"
#include "dynamics/shaft/turn_torque.hpp"
#include "tests/dynamics/chain/timing_drive.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/hydraulic_rig.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/shaft_model.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/dynamics/valve_model.hpp"

#ifndef __SANITIZE_ADDRESS__  // which has an allocator of its own

namespace {

std::atomic<bool> counting{false};
std::atomic<long> allocations{0};

void count() {
  if (counting.load(std::memory_order_relaxed)) allocations.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* old, size_t size);

// Take the place of the C library's functions for all of the program.
void* malloc(size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(size_t number, size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* old, size_t size) {
  count();
  return __libc_realloc(old, size);
}
}

namespace clatter::dynamics {
namespace {

/// Runs `steps` accepted steps after as many before them. Memory is taken for operators of step
/// sizes that are new and for what is said of stages that failed, less than 24 times each and 4
/// times for each of `bodies`, where they are named, and for nothing else.
void expect_no_allocations(Integrator& method, int steps, long long bodies = 0) {
  const auto rare = [&] {
    return method.statistics().operators + method.statistics().rejected_newton;
  };
  for (int i = 0; i < steps; ++i) method.step(1e9);
  const long long before = rare();
  allocations = 0;
  counting = true;
  for (int i = 0; i < steps; ++i) method.step(1e9);
  counting = false;
  EXPECT_LE(allocations, (24 + 4 * bodies) * (rare() - before));
  EXPECT_LE(rare() - before, 20);
}

TEST(Allocation, TheCounterCounts) {
  counting = true;
  allocations = 0;
  Eigen::VectorXd taken(1000);
  counting = false;
  taken.setZero();
  EXPECT_GE(allocations, 1);
}

TEST(Allocation, ContactsOfLinksTakeNoMemory) {
  const Profile wheel = sprocket(iso606_gap(8e-3, 5e-3, 20));
  const Profile curve({BezierSegment{{{{0.02, 0.0}, {0.01, 1e-3}, {-0.01, 1e-3}, {-0.02, 0.0}}}}});
  const MattressLaw law{5e12, 4.6e-3, 0.5, 0.1};
  const MattressContact bush(wheel, LinkOutline::circle(0.0, 2.5e-3), law);
  const MattressContact plate(curve, LinkOutline::plate(-4e-3, 4e-3, 3.6e-3), law);
  MattressForce on_bush, on_plate;
  ContactHint bush_hint, plate_hint;
  counting = true;
  allocations = 0;
  bush.evaluate({{25.48e-3, 0.0}, 1.0, 0.0}, {{0.1, 0.2}, 3.0}, true, bush_hint, on_bush);
  plate.evaluate({{0.0, 4.3e-3}, 1.0, 0.0}, {{0.1, 0.2}, 3.0}, true, plate_hint, on_plate);
  counting = false;
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(on_bush.depth, 0.0);
  EXPECT_GT(on_plate.depth, 0.0);
}

/// Allocations of a rigid piston's contact and of its first step.
long allocations_of(film::PistonLinerOptions options) {
  options.cells_around = options.cells_along = 8;
  options.clearance = 20e-6;
  options.oil_thickness = 5e-6;
  film::PistonLinerBodies bodies;
  bodies.stroke = [](double) { return film::StrokeState{0.2, 3.0}; };
  std::vector<int> coordinates{0, 1, 2, 3, 4, 5};
  Response response;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  const Stage first{1e-6, 1e-6, 0, {}};
  allocations = 0;
  counting = true;
  film::PistonLiner contact(std::move(options), std::move(bodies), std::move(coordinates));
  contact.begin_step(0.0);
  contact.evaluate(first, rest, rest, true, response);
  contact.finish_stage(first);
  contact.accept_step(1e-6);
  counting = false;
  return allocations;
}

TEST(Allocation, EffectsOfTheContactThatAreOffTakeNoMemory) {
  film::PistonLinerOptions plain, layer, laws, shaped;
  layer.liner_layer.emplace();
  layer.liner_layer->bottom = 0.1;
  layer.liner_layer->top = 0.3;
  laws.oil.walther = film::WaltherLaw{{313.0, 373.0}, {1.08e-4, 1.45e-5}, 860.0};
  laws.oil.temperature = {370.0, 400.0};
  laws.oil.height = {0.1, 0.3};
  laws.oil.pressure_coefficient = 2e-8;
  const auto dry = [](film::PistonLinerOptions options) {
    options.effects.film = false;
    return allocations_of(std::move(options));
  };
  set_thread_count(1);  // threads of the pads take memory of their own
  const long film = allocations_of(plain), none = dry(plain);
  EXPECT_LT(none, film);
  for (const auto& options : {layer, laws}) {
    EXPECT_GT(allocations_of(options), film);  // on
    EXPECT_EQ(dry(options), none);             // without a film there is no oil
  }
  shaped.bore_shapes.push_back(
      {Eigen::VectorXd::Zero(1), Eigen::Vector2d(0.1, 0.3), Eigen::RowVector2d(0.0, 1e-5)});
  EXPECT_GT(allocations_of(shaped), film);
  set_thread_count(0);
}

class StepLoop : public ::testing::TestWithParam<const Tableau*> {};
INSTANTIATE_TEST_SUITE_P(Allocation, StepLoop, testing::all_methods(), testing::name_of_method);

TEST_P(StepLoop, TakesNoMemoryForBodiesInContact) {
  System system;
  const int y = system.coordinate(system.add_body(testing::point_mass(1.0)), 0);
  system.add_element(std::make_unique<testing::Wall>(y, 0.0, 1e6, 0.0, 1.0));
  testing::push(system, [](double) { return 10.0; });
  StepOptions options;
  options.method = GetParam();
  options.largest = 1e-4;
  const auto method = make_integrator(system, options);
  method->start(0.0, testing::vector(-1e-4), testing::vector(0.0));
  expect_no_allocations(*method, 2000);
}

TEST_P(StepLoop, TakesNoMemoryForABallThatHopsAndSlidesOnAStop) {
  System system;
  PlanarMotion start;
  start.centre = {0.0, -3e-5};
  start.velocity = {0.5, -0.2};
  const auto ball = testing::add_planar(system, "ball", 1.0, 1e-3, start);
  PointOnPlane pair(std::make_unique<PlanarPort>(ball, Eigen::Vector2d::Zero()),
                    std::make_unique<GroundPort>(Eigen::Vector3d::Zero()),
                    Eigen::Vector3d::UnitY());
  system.add_element(std::make_unique<CompliantStop>("stop", std::move(pair), 1e8, 1.5, 0.1,
                                                     FrictionLaw{0.1, 0.2, 1e-3}));
  system.add_element(std::make_unique<testing::Moment>(ball[1], -20.0));
  StepOptions options;
  options.method = GetParam();
  options.largest = 1e-4;
  const auto method = testing::started(system, options);
  expect_no_allocations(*method, 2000, 1);
}

TEST_P(StepLoop, TakesNoMemoryWhileEventsAreLookedFor) {
  // A body on a spring swings above a rigid stop that it does not reach.
  System system;
  PlanarMotion start;
  start.centre = {0.0, 0.02};
  start.velocity = {0.0, -0.3};
  const auto ball = testing::add_planar(system, "ball", 1.0, 1e-3, start);
  PointOnPlane pair(std::make_unique<PlanarPort>(ball, Eigen::Vector2d::Zero()),
                    std::make_unique<GroundPort>(Eigen::Vector3d::Zero()),
                    Eigen::Vector3d::UnitY());
  system.add_element(std::make_unique<RigidStop>("stop", std::move(pair), 0.5, 1e8, FrictionLaw{}));
  system.add_element(std::make_unique<PairElement>(
      "spring", std::make_unique<PlanarPort>(ball, Eigen::Vector2d::Zero()),
      std::make_unique<GroundPort>(Eigen::Vector3d(0.0, 0.02, 0.0)), linear_joint(1e3, 0.0)));
  StepOptions options;
  options.method = GetParam();
  options.largest = 1e-4;
  const auto method = testing::started(system, options);
  expect_no_allocations(*method, 2000);
  EXPECT_EQ(method->statistics().events, 0);
}

TEST_P(StepLoop, TakesNoMemoryForMechanismsAndChains) {
  testing::Andrews mechanism(1e8, 1e4);
  StepOptions options;
  options.method = GetParam();
  options.largest = 1e-5;
  options.first = 1e-9;
  options.smallest = 1e-13;
  options.accuracy = {1e-4, 1e-3, 1.0, 1e-3};
  const auto method = testing::started(mechanism.system, options);
  expect_no_allocations(*method, 300);
}

TEST_P(StepLoop, TakesNoMemoryForATensioner) {
  testing::ShakenPlunger shaken(CheckValveSpec::Ball::kMoving);
  StepOptions options;
  options.method = GetParam();
  options.largest = 2e-6;
  options.fixed = true;
  const auto method = testing::started(shaken.system, options);
  expect_no_allocations(*method, 1000);
}

TEST_P(StepLoop, TakesNoMemoryForARunningTimingDrive) {
  testing::TimingDrive drive;
  drive.rpm = 3400.0;
  drive.friction = 0.1;
  const auto file = testing::test_folder() / "drive.run.toml";
  std::ofstream(file) << drive.scene();
  const Scene scene = read_scene(file);
  const auto model = build_model(scene, {});
  const ModalStart start = start_state(scene, {}, *model);
  StepOptions options = scene.steps;
  options.method = GetParam();
  const auto method = make_integrator(model->system, options);
  method->start(0.0, start.eta, start.v);
  // By 1.6 ms, in which each link moves on by two pitches.
  expect_no_allocations(*method, 400, static_cast<long long>(model->system.bodies().size()));
}

TEST_P(StepLoop, TakesNoMemoryForACamshaftInItsBearings) {
  testing::ShaftModelOf shaft(
      testing::steel_shaft("speed_rpm = 1700\nslices = 4\nloss_time_us = 1\n") +
      R"(
[[shaft.bearing]]
name = "a"
at_mm = 50
diameter_mm = 24
width_mm = 16
clearance = 2e-3
viscosity_mpa_s = 10
thrust_stiffness_n_m = 1e6
[[shaft.bearing]]
name = "b"
at_mm = 280
model = "moes"
diameter_mm = 24
width_mm = 16
clearance = 2e-3
viscosity_mpa_s = 10
)");
  const auto one = [](double) { return 1.0; };
  shaft.system().add_element(std::make_unique<CamTorque>(
      "cam", shaft.y("shaft.a", 5), std::nullopt,
      CamTrain{CamLaw::polynomial(7.5e-3, 1.2), {0.3}, 2.0, 150.0, 22214.0, 0.08}, one));
  TorqueTable rows;  // many of them in each step
  rows.table.emplace(3, std::vector<double>{0.0, 1e-3, 2e-3, 3e-3},
                     std::vector<double>{0.0, 1.0, 2.0, 1.0}, 4e-3);
  shaft.system().add_element(
      std::make_unique<TableTorque>("torque", shaft.y("shaft.a", 5), std::nullopt, rows, one));
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(6);
  weight(1) = 1.0;
  shaft.system().add_load(
      {"load", 1, weight, [](double time) { return 50.0 * std::sin(300 * time); }});
  StepOptions options;
  options.method = GetParam();
  options.largest = 1e-5;
  const auto method = testing::started(shaft.system(), options);
  expect_no_allocations(*method, 300);
}

TEST_P(StepLoop, TakesNoMemoryForValvesOnTheirCams) {
  // Above the speed at which they float.
  const auto valves = testing::valves_on_a_shaft("full", 4000.0, 2);
  StepOptions options;
  options.method = GetParam();
  options.largest = 2e-6;
  const auto method = testing::started(valves->system(), options);
  expect_no_allocations(*method, 2000);
}

TEST_P(StepLoop, TakesNoMemoryForAnEngineOnItsMounts) {
  testing::EngineVariant variant;
  variant.contact = false;  // the film takes temporary fields of its pads, under 1 % of its time
  const testing::SyntheticEngine engine(variant);
  const auto model = engine.model();
  StepOptions options;
  options.method = GetParam();
  options.largest = 1e-5;
  const auto method = make_integrator(model->system, options);
  const auto modes = model->system.modes();
  method->start(-0.03, Eigen::VectorXd::Zero(modes), Eigen::VectorXd::Zero(modes));
  expect_no_allocations(*method, 3000);
}

}  // namespace
}  // namespace clatter::dynamics

#endif
