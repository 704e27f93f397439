// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies with large motion: ports, free motion, spinning tops, Andrews' mechanism.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "dynamics/body/rotation.hpp"
#include "dynamics/element/spin_element.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::arbitrary;
using testing::started;
using testing::tangent_error;

std::shared_ptr<SpatialFrame> arbitrary_frame(int first) {
  const Eigen::Vector4d q = arbitrary(4, static_cast<unsigned>(20 + first)).normalized();
  return std::make_shared<SpatialFrame>(Vector3d(1.0, 2.0, 2.5).asDiagonal().toDenseMatrix(), q,
                                        Vector3d(0.7, -0.2, 0.4));
}

std::unique_ptr<Port> spatial_port(int first, const Vector3d& arm) {
  std::vector<int> y(kSpatial);
  for (int k = 0; k < kSpatial; ++k) y[k] = first + k;
  return std::make_unique<SpatialPort>(y, arbitrary_frame(first), arm);
}

std::unique_ptr<Port> planar_port(int first, const Eigen::Vector2d& arm) {
  const PlaneAxes plane{{0.1, 0.2, 0.3}, {0.6, 0.0, 0.8}, {0.0, 1.0, 0.0}};
  return std::make_unique<PlanarPort>(std::vector<int>{first, first + 1, first + 2}, arm, plane);
}

TEST(PairElement, TangentsAreTheDifferenceQuotientsOfTheForces) {
  PairElement bushing("bushing", spatial_port(0, {0.3, -0.2, 0.5}), planar_port(10, {0.4, 0.1}),
                      linear_joint(3.0, 0.7));
  PairElement spring("spring", spatial_port(0, {0.3, -0.2, 0.5}), spatial_port(10, {0.0, 0.4, 0.1}),
                     std::make_unique<LineSpring>(3.0, 0.7, 0.2));
  PairElement node(
      "node", std::make_unique<NodePort>(Vector3d(0.2, 0.1, 0.0), std::vector{0, 1, 2, 3, 4, 5}),
      spatial_port(6, {0.3, 0.2, 0.1}), linear_joint(2.0, 0.4));
  SpinElement spin("body", {0, 1, 2, 3, 4, 5, 6}, arbitrary_frame(0), arbitrary(7, 3),
                   VectorXd::Zero(7));
  for (ForceElement* element :
       std::initializer_list<ForceElement*>{&bushing, &spring, &node, &spin}) {
    const int n = static_cast<int>(element->coordinates().size());
    // Central differences with a step of 1e-6 of numbers of size 1: 1e-9.
    EXPECT_LT(tangent_error(*element, arbitrary(n, 1), arbitrary(n, 2)), 1e-8) << element->name();
  }
}

TEST(Port, RotationTurnsTheBodysAxesByItsSpin) {
  const double h = 1e-6;
  DrivenPort driven(Drive(3.0, 0.4), {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, {0.6, 0.0, 0.8});
  NodePort node({0.2, 0.1, 0.0}, {0, 1, 2, 3, 4, 5});
  const auto planar = planar_port(0, {0.4, 0.1});
  for (Port* port : std::initializer_list<Port*>{&driven, planar.get(), &node}) {
    VectorXd y = arbitrary(port->size(), 1), v = arbitrary(port->size(), 2);
    if (port == &node) y *= 1e-6;  // its rotations are small ones
    PortState at, before, after;
    port->motion(0.0, y, v, at);
    port->motion(-h, y - h * v, v, before);
    port->motion(h, y + h * v, v, after);
    const Eigen::Matrix3d rate = (after.rotation - before.rotation) / (2.0 * h);
    EXPECT_LT((rate - skew(at.spin) * at.rotation).norm(), 1e-5 * at.spin.norm());
  }
}

TEST(Port, ADrivenShaftFollowsItsBearingButForItsOwnTurn) {
  const double h = 1e-6;
  const Vector3d place(0.2, 0.1, 0.0), centre(0.5, -0.3, 0.2), axis(0.6, 0.0, 0.8);
  DrivenPort port(Drive(3.0, 0.4), centre, {0.1, 0.2, 0.3}, axis,
                  std::make_unique<NodePort>(place, std::vector<int>{0, 1, 2, 3, 4, 5}));
  const VectorXd y = 1e-6 * arbitrary(6, 1), v = 1e-3 * arbitrary(6, 2);
  PortState at, before, after;
  port.motion(-h, y - h * v, v, before);
  port.motion(h, y + h * v, v, after);
  port.motion(0.0, y, v, at);
  // Small rotations: their squares, and the bearing's tilt under the shaft's spin, are left out.
  EXPECT_LT((after.position - before.position - 2.0 * h * at.velocity).norm(), 2.0 * h * 1e-5);
  const Vector3d moved = at.velocity - at.driven.head<3>();
  EXPECT_LT((at.by_y.topRows<3>() * v - moved).norm(), 1e-15);
  // A force at the point on the bearing: itself, and its moment but for the part about the axis.
  const Vector3d force(3.0, -2.0, 5.0), moment(0.3, 0.1, -0.2);
  Vector6 load;
  load << force, moment;
  const VectorXd on_bearing = at.work.transpose() * load;
  port.motion(0.0, VectorXd::Zero(6), VectorXd::Zero(6), at);
  const Vector3d about_centre = (at.position - centre).cross(force) + moment;
  const Vector3d expected =
      (centre - place).cross(force) + about_centre - axis * axis.dot(about_centre);
  EXPECT_LT((on_bearing.head<3>() - force).norm(), 1e-14);
  EXPECT_LT((on_bearing.tail<3>() - expected).norm(), 1e-14);
}

TEST(Port, RotationTurnsTheArmsOfABody) {
  const VectorXd y = arbitrary(10, 1), v = arbitrary(10, 2);
  PortState first, second;
  spatial_port(0, {0.3, -0.2, 0.5})->motion(0.3, y, v, first);
  spatial_port(0, {-0.1, 0.7, 0.2})->motion(0.3, y, v, second);
  const Vector3d arm = first.rotation * Vector3d(0.4, -0.9, 0.3);
  EXPECT_LT((first.position - second.position - arm).norm(), 1e-14);
}

TEST(PairElement, ForceAndMomentOfAPairBalance) {
  // Two spatial bodies: the sum of forces, and of moments about the origin, vanishes.
  PairElement bushing("bushing", spatial_port(0, {0.3, -0.2, 0.5}),
                      spatial_port(10, {0.4, 0.1, 0.2}), linear_joint(3.0, 0.7));
  const VectorXd y = arbitrary(20, 3), v = arbitrary(20, 4);
  Response response;
  bushing.evaluate({0.0, 0.1, 1, {}}, y, v, false, response);
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  for (const int first : {0, 10}) {
    const Vector3d f = response.force.segment<3>(first);
    force += f;
    moment += response.force.segment<3>(first + kMomentum);
    moment += Vector3d(y.segment<3>(first)).cross(f);
  }
  EXPECT_LT(force.norm(), 1e-14);
  EXPECT_LT(moment.norm(), 1e-14);
}

TEST(PairElement, PowerIsTheWorkOnTheBodies) {
  PairElement bushing("bushing", spatial_port(0, {0.3, -0.2, 0.5}),
                      spatial_port(10, {0.4, 0.1, 0.2}), linear_joint(3.0, 0.7));
  VectorXd y = arbitrary(20, 5), v = arbitrary(20, 6);
  // Attitudes that turn as the angular velocities say, in the frames at rest (time 0).
  std::vector<Vector3d> spins;
  for (const int first : {0, 10}) {
    SpatialState state;
    const auto frame = arbitrary_frame(first);
    const VectorXd y_body = y.segment(first, kSpatial), v_body = v.segment(first, kSpatial);
    frame->rotate(0.0, y_body, v_body, state);
    spins.push_back(state.spin);
    v.segment<4>(first + kTurn) = frame->turn_rate(0.0, y_body, state.spin, nullptr, nullptr);
  }
  Response response;
  bushing.evaluate({0.0, 0.1, 1, {}}, y, v, false, response);
  double work = 0.0;
  for (const int first : {0, 10})
    work += response.force.segment<3>(first).dot(v.segment<3>(first)) +
            response.force.segment<3>(first + kMomentum).dot(spins[first / 10]);
  const double h = 1e-6;
  const auto power = [&](double time) {
    Response unused;
    const Stage stage{time, 0.1, 1, {}};
    bushing.evaluate(stage, y + time * v, v, false, unused);
    bushing.finish_stage(stage);
    return bushing.power(y + time * v, v);
  };
  const double rate = (power(h).stored - power(-h).stored) / (2.0 * h);
  EXPECT_NEAR(-work, rate + power(0.0).lost, 1e-8);
  EXPECT_GT(power(0.0).lost, 0.0);
}

/// A free body of these principal moments after a number of seconds in steps of at most `largest`.
struct FreeBody {
  System system;
  SpatialBody body;
  std::unique_ptr<Integrator> method;
  Vector3d inertia;

  FreeBody(const Vector3d& moments, const SpatialMotion& start, double largest,
           const Tableau& tableau)
      : body(add_spatial_body(system, make_spatial_body("body", 1.0, moments, start))),
        inertia(moments) {
    StepOptions options;
    options.method = &tableau;
    options.largest = largest;
    options.accuracy = {1e-3, 1.0, 10.0, 1.0};
    method = started(system, options);
  }
  double energy() const {
    const Vector3d w = body.spin(method->state());
    return w.dot(inertia.cwiseProduct(w));
  }
  Eigen::Matrix3d attitude() const { return rotation_matrix(body.quaternion(method->state())); }
  Vector3d momentum() const {
    return attitude() * inertia.cwiseProduct(body.spin(method->state()));
  }
};

TEST(RigidBody, FreeRotationKeepsEnergyAndMomentumOverTenThousandTurns) {
  // About the intermediate axis, where the rotation is unstable: the body tumbles.
  SpatialMotion start;
  start.spin = Vector3d(0.01, 2.0 * std::numbers::pi, 0.01);
  for (const Tableau* tableau : {&tr_bdf2(), &sdirk2(), &predictor_corrector()}) {
    const double turns = tableau == &tr_bdf2() ? 1e4 : 1e3;
    FreeBody one({1.0, 2.0, 2.5}, start, 1.0, *tableau);
    const double e = one.energy();
    const Vector3d m = one.momentum();
    double energy = 0.0, momentum = 0.0, flipped = 1.0;
    while (one.method->state().time < turns) {
      one.method->step(turns);
      energy = std::max(energy, std::abs(one.energy() / e - 1.0));
      momentum = std::max(momentum, (one.momentum() - m).norm() / m.norm());
      flipped = std::min(flipped, one.body.spin(one.method->state()).y() / start.spin.y());
    }
    std::printf("%.0f turns, %s: energy %.1e, momentum %.1e, %lld steps\n", turns,
                tableau->name.c_str(), energy, momentum, one.method->statistics().accepted);
    // Up to 1e4 steps of some roundings each.
    EXPECT_LT(energy, 1e-11);
    EXPECT_LT(momentum, 1e-11);
    EXPECT_LT(flipped, -0.5);
  }
}

TEST(RigidBody, AFreeSymmetricBodyPrecessesAsTheoryGives) {
  // About L at the rate |L| / A, and about its own axis at w_z (1 - C / A) (Goldstein 1980, 5-6).
  const double A = 2.0, C = 3.0, end = 1000.0;
  SpatialMotion start;
  start.spin = Vector3d(1.0, 0.0, 5.0);
  start.rotation = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized());
  FreeBody one({A, A, C}, start, 0.5, tr_bdf2());
  const Vector3d L = one.momentum();
  while (one.method->state().time < end) one.method->step(end);
  // The run starts 1e-7 s before 0.
  const double time = end + 1e-7;
  const Eigen::Matrix3d expected =
      Eigen::AngleAxisd(L.norm() / A * time, L.normalized()) * start.rotation.toRotationMatrix() *
      Eigen::AngleAxisd(start.spin.z() * (1.0 - C / A) * time, Vector3d::UnitZ());
  const double error = (one.attitude() - expected).norm();
  std::printf("attitude after %.0f turns: %.1e\n", L.norm() / A * end / (2.0 * std::numbers::pi),
              error);
  EXPECT_LT(error, 1e-9);
}

TEST(RigidBody, SteadyTopPrecessesAtTheRateOfTheory) {
  // A symmetric top on its tip, axis at angle a from the vertical, in steady precession P with spin
  // s about its axis: m g l = C s P - (A - C) P^2 cos(a)  with s + P cos(a) = w_z (Goldstein 1980,
  // eq. 5-77): m g l = P (C w_z - A P cos(a)).
  const double mass = 0.5, arm = 0.05, A0 = 2e-4, C = 3e-4, gravity = 9.81, a = 0.4, P = 3.0;
  const double A = A0 + mass * arm * arm;
  const double w_z = (mass * gravity * arm / P + A * P * std::cos(a)) / C;
  System system;
  SpatialMotion start;
  start.rotation = Eigen::AngleAxisd(a, Vector3d::UnitX());
  const Vector3d w_engine = Vector3d(0.0, 0.0, P);
  start.spin = start.rotation.conjugate() * w_engine;
  start.spin.z() = w_z;
  start.centre = start.rotation * Vector3d(0.0, 0.0, arm);
  start.velocity = w_engine.cross(start.centre);
  const SpatialBody top =
      add_spatial_body(system, make_spatial_body("top", mass, {A0, A0, C}, start));
  const double k = 1e7;
  system.add_element(std::make_unique<PairElement>("tip", top.port({0.0, 0.0, -arm}),
                                                   std::make_unique<GroundPort>(Vector3d::Zero()),
                                                   linear_joint(k, 2.0 * std::sqrt(k * mass))));
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(kSpatial);
  weight(2) = std::sqrt(mass);
  system.add_load({"gravity", 0, weight, [gravity](double) { return -gravity; }});
  StepOptions options;
  options.largest = 1e-3;
  options.first = 1e-8;
  options.accuracy = {1e-5, arm, 0.2, arm};
  const auto method = started(system, options);
  const double end = 1.0;
  while (method->state().time < end) method->step(end);
  const Vector3d axis = rotation_matrix(top.quaternion(method->state())) * Vector3d::UnitZ();
  const double azimuth = std::atan2(axis.x(), -axis.y());
  double expected = std::fmod(P * end, 2.0 * std::numbers::pi);
  if (expected > std::numbers::pi) expected -= 2.0 * std::numbers::pi;
  std::printf("azimuth %.6f (theory %.6f), nutation %.2e rad, %lld steps\n", azimuth, expected,
              std::acos(axis.z()) - a, method->statistics().accepted);
  EXPECT_NEAR(azimuth, expected, 3e-3);
  EXPECT_NEAR(std::acos(axis.z()), a, 1e-3);
}

/// The angle of a rod of 1 kg on a crank pin that circles, held by a spring, over half a second.
/// @param flywheel moment of inertia of a crank that turns freely; 0: its rotation is prescribed.
std::vector<double> rod_angles(double flywheel, double* residue = nullptr) {
  const double radius = 0.05, half = 0.1, speed = 20.0;
  const Eigen::Vector2d pin(radius, 0.0);
  System system;
  PlanarMotion start;
  start.centre = {radius, -half};
  start.angle = -std::numbers::pi / 2;
  start.velocity = {0.0, radius * speed};
  const auto rod = testing::add_planar(system, "rod", 1.0, 1.0 * half * half / 3.0, start);
  const auto of_rod = [&](double arm) -> std::unique_ptr<Port> {
    return std::make_unique<PlanarPort>(rod, Eigen::Vector2d(arm, 0.0));
  };
  std::unique_ptr<Port> crank_pin;
  if (flywheel > 0.0) {
    PlanarMotion turning;
    turning.spin = speed;
    const auto crank = testing::add_planar(system, "crank", 50.0, flywheel, turning);
    system.add_element(std::make_unique<PairElement>(
        "bearing", std::make_unique<PlanarPort>(crank, Eigen::Vector2d::Zero()),
        std::make_unique<GroundPort>(Vector3d::Zero()), linear_joint(1e9, 1e4)));
    crank_pin = std::make_unique<PlanarPort>(crank, pin);
  } else {
    crank_pin = std::make_unique<DrivenPort>(Drive(speed), Vector3d::Zero(),
                                             Vector3d(radius, 0.0, 0.0), Vector3d::UnitZ());
  }
  system.add_element(std::make_unique<PairElement>("pin", std::move(crank_pin), of_rod(-half),
                                                   linear_joint(1e8, 1e3)));
  system.add_element(std::make_unique<PairElement>(
      "spring", of_rod(half), std::make_unique<GroundPort>(Vector3d(0.3, -0.4, 0.0)),
      std::make_unique<LineSpring>(200.0, 0.5, 0.1)));
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-3;
  options.first = 1e-9;
  options.accuracy = {1e-5, 1e-3, 0.1, 0.1};
  const auto method = make_integrator(system, options);
  method->set_observer(&energy);
  method->start(-options.first, system.eta_start(), system.v_start());
  std::vector<double> angles;
  for (int k = 1; k <= 50; ++k) {
    while (method->state().time < 0.01 * k) method->step(0.01 * k);
    angles.push_back(method->state().y(rod[2]));
  }
  if (residue != nullptr) *residue = energy.residue();
  return angles;
}

TEST(Drive, AFreeCrankTendsToThePrescribedOneAsItsFlywheelGrows) {
  double residue = 1.0;
  const auto prescribed = rod_angles(0.0, &residue);
  EXPECT_LT(residue, 1e-4);
  double before = 0.0;
  for (const double flywheel : {1.0, 10.0, 100.0, 1000.0}) {
    const auto found = rod_angles(flywheel);
    double worst = 0.0;
    for (size_t k = 0; k < found.size(); ++k)
      worst = std::max(worst, std::abs(found[k] - prescribed[k]));
    std::printf("flywheel %6.0f kg m2: %.2e rad from the prescribed crank\n", flywheel, worst);
    // The speed that the rod takes from the crank is in inverse proportion to the flywheel.
    EXPECT_LT(worst, before > 0.0 ? 0.2 * before : 1.0) << flywheel;
    before = worst;
  }
}

TEST(Drive, OrdersAddToTheSpeedAndTheAngleIsItsIntegral) {
  const Drive drive(100.0, 0.3, {{1.5, 4.0, 0.7}, {3.0, 1.0, -0.2}});
  EXPECT_DOUBLE_EQ(drive.at(0.0).position, 0.3);
  const double h = 1e-5;
  for (const double t : {0.0, 0.013, 0.4}) {
    const auto at = drive.at(t), low = drive.at(t - h), high = drive.at(t + h);
    EXPECT_NEAR(at.velocity, 100.0 + 4.0 * std::cos(150.0 * t + 0.7) + std::cos(300.0 * t - 0.2),
                1e-12);
    EXPECT_NEAR(at.velocity, (high.position - low.position) / (2.0 * h), 1e-5);
    EXPECT_NEAR(at.acceleration, (high.velocity - low.velocity) / (2.0 * h), 1e-3);
  }
}

/// The largest error of the seven angles of Andrews' mechanism at 0.03 s.
double andrews_error(const Tableau& method, double stiffness, double tolerance,
                     StepStatistics* statistics = nullptr) {
  // Test Set for IVP Solvers (release 2.4), problem ANDREWS.
  const double reference[7] = {0.1581077119629904e2, -0.1575637105984298e2, 0.4082224013073101e-1,
                               -0.5347301163226948,  0.5244099658805304,    0.5347301163226948,
                               0.1048080741042263e1};
  testing::Andrews mechanism(stiffness, 1e4);
  StepOptions options;
  options.method = &method;
  options.first = 1e-9;
  options.smallest = 1e-13;
  options.accuracy = {tolerance, 1e-3, 1.0, 1e-3};
  const auto run = started(mechanism.system, options);
  while (run->state().time < 0.03) run->step(0.03);
  const auto angles = mechanism.angles(run->state().y);
  if (statistics != nullptr) *statistics = run->statistics();
  double worst = 0.0;
  for (int k = 0; k < 7; ++k) worst = std::max(worst, std::abs(angles(k) - reference[k]));
  return worst;
}

TEST(Andrews, JointsOfStiffBushingsTendToTheIdealMechanism) {
  // The joints' give is an error of the first order in 1 / k: 1.9e-2 rad of 15.8 at 1e8 N/m.
  const double soft = andrews_error(tr_bdf2(), 1e8, 1e-6),
               stiff = andrews_error(tr_bdf2(), 1e10, 1e-6);
  EXPECT_NEAR(soft / stiff, 100.0, 70.0);
}

TEST(Andrews, AnglesAgreeWithTheTestSetAsTheToleranceSays) {
  StepStatistics dirk, corrected;
  const double by_dirk = andrews_error(tr_bdf2(), 1e12, 1e-6, &dirk);
  const double by_corrector = andrews_error(predictor_corrector(), 1e12, 1e-5, &corrected);
  std::printf("tr-bdf2: error %.1e rad in %lld steps; predictor-corrector: %.1e in %lld\n", by_dirk,
              dirk.accepted, by_corrector, corrected.accepted);
  EXPECT_LT(by_dirk, 1e-4);
  EXPECT_LT(by_corrector, 1e-4);
  EXPECT_EQ(dirk.rejected_newton, 0);
}

}  // namespace
}  // namespace clatter::dynamics
