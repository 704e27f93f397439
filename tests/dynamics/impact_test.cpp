// SPDX-License-Identifier: GPL-3.0-or-later
// Impacts of rigid and elastic bodies: impulses keep what they must keep, and change the rest.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>

#include "dynamics/body/floating_body.hpp"
#include "dynamics/element/stop.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/truss.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::arbitrary;
using testing::started;

StepOptions fine_steps() {
  StepOptions options;
  options.largest = 1e-3;
  options.first = 1e-9;
  options.accuracy = {1e-6, 1e-3, 0.1, 0.05};
  return options;
}

/// A rigid contact that shows the state of its element's coordinates before each impulse. Local
/// coordinates of attitudes start again after it, so that looking later would be too late.
class WatchedStop : public RigidStop {
 public:
  using RigidStop::RigidStop;
  std::optional<Touch> touch(double time, const VectorXd& y, const VectorXd& v) const override {
    const auto found = RigidStop::touch(time, y, v);
    if (found && look) look(time, y, v);
    return found;
  }
  std::function<void(double, const VectorXd&, const VectorXd&)> look;
};

/// The energy balance; it shows the state after each event.
class WatchedEnergy : public EnergyBalance {
 public:
  using EnergyBalance::EnergyBalance;
  void stage(int index, const StageState& state) override {
    EnergyBalance::stage(index, state);
    if (index == 0 && look) look(state);
  }
  std::function<void(const StageState&)> look;
};

/// Adds a rigid contact of a point with a plane at rest.
WatchedStop* add_watched_stop(System& system, std::unique_ptr<Port> point, const Vector3d& on_plane,
                              const Vector3d& normal, double restitution) {
  auto stop = std::make_unique<WatchedStop>(
      "wall", PointOnPlane(std::move(point), std::make_unique<GroundPort>(on_plane), normal),
      restitution, 1e8, FrictionLaw{});
  WatchedStop* kept = stop.get();
  system.add_element(std::move(stop));
  return kept;
}

void step_to_impact(Integrator& method, double end) {
  while (method.statistics().events == 0 && method.state().time < end) method.step(end);
  ASSERT_EQ(method.statistics().events, 1);
}

/// The motion of a port by the y and v_y of its body's coordinates.
PortState motion_of(Port& port, double time, const VectorXd& y, const VectorXd& v) {
  PortState at;
  port.motion(time, y, v, at);
  return at;
}

struct RigidMotion {
  Vector3d velocity, spin;  // of the centre; angular velocity, in the engine's axes
  Matrix3d rotation;
};

RigidMotion rigid_motion(const SpatialBody& body, double time, const VectorXd& y,
                         const VectorXd& v) {
  const PortState at = motion_of(*body.port(Vector3d::Zero()), time, y, v);
  return {at.velocity, at.spin, at.rotation};
}

RigidMotion rigid_motion(const SpatialBody& body, const StageState& state) {
  return rigid_motion(body, state.time, gather(state.y, body.coordinates),
                      gather(state.v_y, body.coordinates));
}

TEST(Impact, OfAFreeRodAtItsEndGivesItTheSpinOfTheTextbook) {
  // A rod along x falls flat with v; its end meets the ground: a quarter of its mass acts there,
  // J = (1 + e) v m / 4, v' = -v + J / m, w = 6 J / (m l).
  const double m = 2.0, l = 0.6, v = 1.5, e = 0.5, moment = m * l * l / 12.0;
  System system;
  SpatialMotion start;
  start.centre = {0.0, 0.0, 1e-3};
  start.velocity = {0.2, 0.0, -v};
  const SpatialBody rod =
      add_spatial_body(system, make_spatial_body("rod", m, {1e-6, moment, moment}, start));
  add_watched_stop(system, rod.port({0.5 * l, 0.0, 0.0}), Vector3d::Zero(), Vector3d::UnitZ(), e);
  const auto method = started(system, fine_steps());
  step_to_impact(*method, 0.01);
  const double impulse = (1.0 + e) * v * m / 4.0;
  const RigidMotion after = rigid_motion(rod, method->state());
  EXPECT_NEAR(after.velocity.z(), -v + impulse / m, 1e-9);
  EXPECT_NEAR(after.velocity.x(), 0.2, 1e-12);
  EXPECT_NEAR(after.spin.y(), -6.0 * impulse / (m * l), 1e-8);
  EXPECT_NEAR(std::hypot(after.spin.x(), after.spin.z()), 0.0, 1e-9);
  // The rod goes on: its attitude follows the new spin.
  const double hit = method->state().time, later = hit + 0.1;
  while (method->state().time < later) method->step(later);
  const Matrix3d turned = rigid_motion(rod, method->state()).rotation;
  EXPECT_NEAR(std::atan2(-turned(2, 0), turned(0, 0)), -6.0 * impulse / (m * l) * 0.1, 1e-8);
}

TEST(Impact, OfATumblingBoxKeepsTheMomentaThatNoNormalImpulseChanges) {
  const double m = 1.3, e = 0.4;
  const Vector3d J(0.004, 0.007, 0.009), n = Vector3d(0.3, -0.2, 1.0).normalized();
  const Vector3d corner(0.11, -0.08, -0.05);
  SpatialMotion start;
  start.rotation = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, -0.5).normalized());
  start.velocity = {1.0, 0.5, -2.0};
  start.spin = {3.0, -8.0, 5.0};
  System system;
  const SpatialBody box = add_spatial_body(system, make_spatial_body("box", m, J, start));
  // The plane is 2 mm before the corner.
  const Vector3d there = start.rotation * corner - 2e-3 * n;
  WatchedStop* const wall = add_watched_stop(system, box.port(corner), there, n, e);
  WatchedEnergy energy(system);
  const auto method = make_integrator(system, fine_steps());
  method->set_observer(&energy);
  method->start(-1e-9, system.eta_start(), system.v_start());
  RigidMotion before, after;
  wall->look = [&](double time, const VectorXd& y, const VectorXd& v) {
    before = rigid_motion(box, time, y, v);
  };
  energy.look = [&](const StageState& state) { after = rigid_motion(box, state); };
  step_to_impact(*method, 0.05);
  EXPECT_LT((before.rotation - after.rotation).norm(), 1e-14);
  const Vector3d arm = after.rotation * corner;
  const Matrix3d inertia = after.rotation * J.asDiagonal() * after.rotation.transpose();
  const Vector3d change = m * (after.velocity - before.velocity);
  EXPECT_LT((change - n.dot(change) * n).norm(), 1e-12);
  // About the contact point: I w - m arm x v is kept.
  const auto about = [&](const RigidMotion& at) -> Vector3d {
    return inertia * at.spin - m * arm.cross(at.velocity);
  };
  EXPECT_LT((about(after) - about(before)).norm(), 1e-12 * about(before).norm());
  const auto normal_speed = [&](const RigidMotion& at) {
    return n.dot(at.velocity + at.spin.cross(arm));
  };
  EXPECT_LT(normal_speed(before), -0.1);
  EXPECT_NEAR(normal_speed(after), -e * normal_speed(before), 1e-12);
  const auto kinetic = [&](const RigidMotion& at) {
    return 0.5 * m * at.velocity.squaredNorm() + 0.5 * at.spin.dot(inertia * at.spin);
  };
  const double mass = 1.0 / (1.0 / m + n.dot((inertia.inverse() * arm.cross(n)).cross(arm)));
  const double loss = 0.5 * mass * (1.0 - e * e) * std::pow(normal_speed(before), 2);
  EXPECT_NEAR(kinetic(before) - kinetic(after), loss, 1e-11);
  EXPECT_NEAR(energy.now().lost, loss, 1e-9);
  EXPECT_LT(energy.residue(), 1e-9);
}

TEST(Impact, IsTheSameForABodyInAPlaneAndInSpace) {
  // Impacts on two walls, so that the second one begins with the spin of the first.
  const double m = 0.8, moment = 0.003, e = 0.7, end = 0.05;
  const auto options = [] {
    StepOptions steps = fine_steps();
    steps.accuracy.tolerance = 1e-8;
    return steps;
  }();
  const std::array<Vector3d, 2> corner{Vector3d(0.05, -0.1, 0.0), Vector3d(0.09, 0.0, 0.0)};
  const std::array<Vector3d, 2> wall{Vector3d(0.0, -0.13, 0.0), Vector3d(0.0, 0.01, 0.0)};
  const std::array<Vector3d, 2> normal{Vector3d::UnitY(), -Vector3d::UnitY()};
  PlanarMotion flat;
  flat.velocity = {0.3, -2.0};
  flat.spin = 4.0;
  System plane;
  const auto y = testing::add_planar(plane, "plate", m, moment, flat);
  SpatialMotion free;
  free.velocity = {0.3, -2.0, 0.0};
  free.spin = {0.0, 0.0, 4.0};
  System space;
  const SpatialBody body =
      add_spatial_body(space, make_spatial_body("plate", m, {0.002, 0.003, moment}, free));
  for (size_t k = 0; k < 2; ++k) {
    add_watched_stop(plane, std::make_unique<PlanarPort>(y, corner[k].head<2>()), wall[k],
                     normal[k], e);
    add_watched_stop(space, body.port(corner[k]), wall[k], normal[k], e);
  }
  const auto one = started(plane, options), other = started(space, options);
  while (one->state().time < end) one->step(end);
  while (other->state().time < end) other->step(end);
  EXPECT_GE(one->statistics().events, 2);
  EXPECT_EQ(one->statistics().events, other->statistics().events);
  const RigidMotion at = rigid_motion(body, other->state());
  EXPECT_NEAR(one->state().v_y(y[0]), at.velocity.x(), 1e-8);
  EXPECT_NEAR(one->state().v_y(y[1]), at.velocity.y(), 1e-6);
  EXPECT_NEAR(one->state().v_y(y[2]), at.spin.z(), 1e-5);
  EXPECT_NEAR(one->state().y(y[2]), std::atan2(at.rotation(1, 0), at.rotation(0, 0)), 1e-7);
}

TEST(Impact, OnANodeOfAFloatingTrussMovesThatMassAlone) {
  // All modes of the truss are kept, so its masses are free: an impulse on one of them changes the
  // velocity of no other, whatever frame, turn and modes do to describe it.
  const testing::Truss truss = testing::octahedron(2e4);
  ElasticStart start;
  start.frame.rotation = Eigen::AngleAxisd(0.8, Vector3d(1.0, -2.0, 0.5).normalized());
  start.frame.velocity = {0.4, 0.1, -1.0};
  start.frame.spin = {2.0, 5.0, -3.0};
  start.q = 0.005 * arbitrary(12, 7);
  start.rate = 0.5 * arbitrary(12, 8);
  const ModalBody free = make_modal_body(truss.model(), {});
  const FloatingBody floating =
      make_floating_body("truss", mean_axis_shapes(free, truss.invariants()), start);
  System system;
  const SpatialBody body = add_spatial_body(system, floating.body);
  const auto port = [&](size_t node) {
    return body.port(floating.arm(truss.node[node]),
                     floating.shape(free.shapes.rightCols(12).middleRows<3>(
                         static_cast<Eigen::Index>(3 * node))));
  };
  const auto motion = [&](size_t node, double time, const VectorXd& y, const VectorXd& v) {
    return motion_of(*port(node), time, y, v);
  };
  const size_t hit = 2;
  const PortState there =
      motion(hit, 0.0, system.interface(system.eta_start()), system.interface(system.v_start()));
  const Vector3d n = -there.velocity.normalized();
  const double e = 0.6;
  WatchedStop* const wall = add_watched_stop(system, port(hit), there.position - 1e-3 * n, n, e);
  WatchedEnergy energy(system);
  const auto method = make_integrator(system, fine_steps());
  method->set_observer(&energy);
  method->start(-1e-9, system.eta_start(), system.v_start());
  const size_t nodes = truss.node.size();
  std::vector<Vector3d> before(nodes), after(nodes);
  wall->look = [&](double time, const VectorXd& y, const VectorXd& v) {
    for (size_t i = 0; i < nodes; ++i) before[i] = motion(i, time, y, v).velocity;
  };
  energy.look = [&](const StageState& state) {
    for (size_t i = 0; i < nodes; ++i)
      after[i] = motion(i, state.time, gather(state.y, body.coordinates),
                        gather(state.v_y, body.coordinates))
                     .velocity;
  };
  step_to_impact(*method, 0.05);
  double kinetic = 0.0;
  for (size_t i = 0; i < nodes; ++i) {
    kinetic += 0.5 * truss.mass[i] * (before[i].squaredNorm() - after[i].squaredNorm());
    const Vector3d expected =
        i == hit ? Vector3d(-(1.0 + e) * n.dot(before[i]) * n) : Vector3d(Vector3d::Zero());
    EXPECT_LT((after[i] - before[i] - expected).norm(), 1e-11) << i;
  }
  EXPECT_GT(n.dot(after[hit] - before[hit]), 1.0);
  EXPECT_NEAR(energy.now().lost, kinetic, 1e-11);
  energy.look = nullptr;
  // The motion after it keeps energy and follows from the new momenta.
  const double stored = energy.now().stored();
  const double later = method->state().time + 1e-3;
  while (method->state().time < later && method->statistics().events == 1) method->step(later);
  EXPECT_NEAR(energy.now().stored(), stored, 1e-6 * stored);
}

/// Two bodies in contact at a point of a plane that turns with the second one.
struct Pair {
  System system;
  SpatialBody a, b;
  VectorXd y, v;
  Pair() {
    a = add_spatial_body(system, make_spatial_body("a", 2.0, {0.02, 0.03, 0.04}, {}));
    b = add_spatial_body(system, make_spatial_body("b", 3.0, {0.05, 0.04, 0.03}, {}));
    y = arbitrary(20, 1);
    v = arbitrary(20, 2);
    y.segment<3>(10) += Vector3d(0.2, 0.1, 1.5);  // b above the point: inside its plane
  }
  PointOnPlane pair() const {
    return PointOnPlane(a.port({0.1, 0.2, -0.3}), b.port({0.0, -0.1, 0.2}), Vector3d::UnitZ());
  }
};

TEST(Stop, TangentsAreTheDifferenceQuotientsOfTheForces) {
  const Pair bodies;
  // Slip below, between and above the two speeds at which the coefficient changes; creeping,
  // sticking, and sliding on the same spring.
  for (const double slip_speed : {1e2, 4.0, 1e-1})
    for (const double exponent : {1.0, 1.5})
      for (const double stiffness : {0.0, 0.1, 100.0}) {
        FrictionLaw friction{0.3, 0.5, slip_speed, stiffness, 0.01};
        if (stiffness > 0.0) friction.slip_speed.reset();
        CompliantStop stop("stop", bodies.pair(), 3.0, exponent, 0.02, friction);
        Response at;
        stop.evaluate({0.1, 0.03, 1, {0.03}}, bodies.y, bodies.v, false, at);
        ASSERT_GT(at.force.norm(), 0.1);
        EXPECT_LT(testing::tangent_error(stop, bodies.y, bodies.v), 1e-7)
            << slip_speed << " " << exponent << " " << stiffness;
      }
}

TEST(Stop, ForcesAndMomentsBalance) {
  const Pair bodies;
  CompliantStop stop("stop", bodies.pair(), 3.0, 1.5, 0.02, {0.3, 0.5, 0.1});
  Response at;
  stop.evaluate({0.1, 0.03, 1, {0.03}}, bodies.y, bodies.v, false, at);
  const Vector3d f_a = at.force.segment<3>(0), f_b = at.force.segment<3>(10);
  EXPECT_GT(f_a.norm(), 0.1);
  EXPECT_LT((f_a + f_b).norm(), 1e-14 * f_a.norm());
  const Vector3d moment = bodies.y.segment<3>(0).cross(f_a) + bodies.y.segment<3>(10).cross(f_b) +
                          at.force.segment<3>(kMomentum) + at.force.segment<3>(10 + kMomentum);
  EXPECT_LT(moment.norm(), 1e-14 * f_a.norm());
}

}  // namespace
}  // namespace clatter::dynamics
