// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic bodies that move freely: eq. (9) against sums over their masses.
#include "dynamics/body/floating_body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "dynamics/element/spin_element.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/truss.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::arbitrary;
using testing::octahedron;
using testing::started;
using testing::Truss;
using testing::vector;

/// A truss in mean axes, free in space.
struct FloatingTruss {
  Truss truss;
  FloatingBody floating;
  System system;
  SpatialBody body;

  FloatingTruss(const Truss& of, const ElasticStart& start, const ModalBody& free)
      : truss(of),
        floating(make_floating_body("truss", mean_axis_shapes(free, truss.invariants()), start)),
        body(add_spatial_body(system, floating.body)),
        shapes_(free.shapes.rightCols(free.modes() - 6)) {}
  FloatingTruss(const Truss& of, const ElasticStart& start)
      : FloatingTruss(of, start, make_modal_body(of.model(), {})) {}

  /// Displacement of a node from the centre of mass by the modes.
  Matrix3X shape(size_t node) const {
    return floating.shape(shapes_.middleRows<3>(static_cast<Eigen::Index>(3 * node)));
  }
  Vector3d arm(size_t node) const { return floating.arm(truss.node[node]); }
  std::unique_ptr<Port> port(size_t node) const { return body.port(arm(node), shape(node)); }
  VectorXd eta(const VectorXd& modal) const { return modal.tail(body.frame->modes()); }
  PortState at(size_t node, const StageState& state) const {
    PortState found;
    port(node)->motion(state.time, gather(state.y, body.coordinates),
                       gather(state.v_y, body.coordinates), found);
    return found;
  }

 private:
  MatrixXd shapes_;
};

ElasticStart tumbling(double turns_per_second, double amplitude, int modes) {
  ElasticStart start;
  start.frame.centre = {0.3, -0.1, 0.2};
  start.frame.rotation = Eigen::AngleAxisd(0.8, Vector3d(1.0, -2.0, 0.5).normalized());
  start.frame.velocity = {0.4, 0.1, -0.3};
  start.frame.spin = turns_per_second * 2.0 * std::numbers::pi * Vector3d(0.5, 0.8, -0.3);
  start.q = amplitude * arbitrary(modes, 7);
  start.rate = 100.0 * amplitude * arbitrary(modes, 8);
  return start;
}

TEST(FloatingBody, TangentsAreTheDifferenceQuotientsOfTheForces) {
  const FloatingTruss one(octahedron(1e5), tumbling(1.0, 0.05, 12));
  const VectorXd y = arbitrary(22, 1), v = arbitrary(22, 2);
  std::vector<int> own(19), all(22);
  for (int k = 0; k < 22; ++k) all[k] = k;
  for (int k = 0; k < 19; ++k) own[k] = k;
  SpinElement spin("truss", own, one.floating.body.frame, arbitrary(19, 3), arbitrary(19, 4));
  EXPECT_LT(testing::tangent_error(spin, y.tail(19), v.tail(19)), 1e-8);
  const Matrix3X slope = Eigen::Map<const MatrixXd>(arbitrary(36, 5).eval().data(), 3, 12);
  PairElement bushing(
      "bushing",
      std::make_unique<SpatialPort>(all, one.body.frame, one.arm(2), one.shape(2), slope),
      std::make_unique<GroundPort>(Vector3d(0.1, 0.5, 0.2)), linear_joint(3.0, 0.7));
  EXPECT_LT(testing::tangent_error(bushing, y, v), 1e-8);
}

/// Largest residual of eq. (9) in the modes, relative to the largest term, along one second.
double residual_of_equation_nine(double tolerance) {
  FloatingTruss one(octahedron(2e4), tumbling(1.5, 0.005, 12));
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {tolerance, 1e-3, 0.1, 0.2};
  const auto method = started(one.system, options);
  double worst = 0.0, scale = 0.0;
  while (method->state().time < 0.5) {
    method->step(0.5);
    const StageState& state = method->state();
    const VectorXd eta = one.eta(state.eta), v = one.eta(state.v), a = one.eta(state.a);
    const Vector3d w = one.body.spin(state);
    // Euler's equation of all masses gives w' by the sums alone; then each mode's own equation.
    Matrix3d J = Matrix3d::Zero();
    Vector3d moment = Vector3d::Zero();
    std::vector<Vector3d> rest, place;
    for (size_t i = 0; i < one.truss.node.size(); ++i) {
      const Matrix3X S = one.shape(i);
      const Vector3d x = one.arm(i) + S * eta;
      place.push_back(x);
      rest.push_back(w.cross(w.cross(x)) + 2.0 * w.cross(S * v) + S * a);
      J += one.truss.mass[i] * (x.squaredNorm() * Matrix3d::Identity() - x * x.transpose());
      moment += one.truss.mass[i] * x.cross(rest.back());
    }
    const Vector3d w_rate = -J.inverse() * moment;
    VectorXd force = VectorXd::Zero(12);
    for (size_t i = 0; i < place.size(); ++i)
      force += one.truss.mass[i] * one.shape(i).transpose() * (w_rate.cross(place[i]) + rest[i]);
    const VectorXd elastic = one.floating.body.omega_squared.tail(12).cwiseProduct(eta);
    worst = std::max(worst, (force + elastic).cwiseAbs().maxCoeff());
    scale = std::max(scale, elastic.cwiseAbs().maxCoeff());
  }
  return worst / scale;
}

TEST(FloatingBody, EquationNineIsTheSumOverTheMasses) {
  const double coarse = residual_of_equation_nine(1e-3), fine = residual_of_equation_nine(1e-5);
  std::printf("residual of eq. (9) by sums over the masses: %.1e, %.1e of the elastic force\n",
              coarse, fine);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.2 * coarse);
}

TEST(FloatingBody, FreeFlightKeepsEnergyAndBothMomenta) {
  FloatingTruss one(octahedron(2e4), tumbling(1.5, 0.005, 12));
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-5, 1e-3, 0.1, 0.2};
  EnergyBalance energy(one.system);
  const auto method = make_integrator(one.system, options);
  method->set_observer(&energy);
  method->start(-options.first, one.system.eta_start(), one.system.v_start());
  // By sums over the masses: momentum, and angular momentum about the origin of space.
  const auto sums = [&] {
    Eigen::Matrix<double, 6, 1> found = Eigen::Matrix<double, 6, 1>::Zero();
    for (size_t i = 0; i < one.truss.node.size(); ++i) {
      const PortState at = one.at(i, method->state());
      found.head<3>() += one.truss.mass[i] * at.velocity;
      found.tail<3>() += one.truss.mass[i] * at.position.cross(at.velocity);
    }
    return found;
  };
  const auto kinetic = [&] {
    double sum = 0.0;
    for (size_t i = 0; i < one.truss.node.size(); ++i)
      sum += 0.5 * one.truss.mass[i] * one.at(i, method->state()).velocity.squaredNorm();
    return sum;
  };
  const auto before = sums();
  const double stored = energy.now().stored();
  double change = 0.0, momentum = 0.0, sum_error = 0.0;
  while (method->state().time < 1.0) {
    method->step(1.0);
    momentum = std::max(momentum, (sums() - before).norm() / before.norm());
    change = std::max(change, std::abs(energy.now().stored() / stored - 1.0));
    const double of_masses = kinetic() + energy.now().strain;
    sum_error = std::max(sum_error, std::abs(energy.now().stored() / of_masses - 1.0));
  }
  std::printf("energy %.1e, momenta %.1e, energy against the sum over the masses %.1e\n", change,
              momentum, sum_error);
  EXPECT_LT(momentum, 1e-12);
  EXPECT_LT(sum_error, 1e-12);
  EXPECT_LT(change, 1e-4);
}

/// Largest distance between the nodes of the floating body and the same masses and springs in
/// absolute coordinates, relative to the largest elastic displacement.
double distance_from_nodal(double turns_per_second, double amplitude) {
  const double end = 0.05;
  FloatingTruss one(octahedron(2e5), tumbling(turns_per_second, amplitude, 12));
  const size_t nodes = one.truss.node.size();
  StageState first;
  first.y = one.system.interface(one.system.eta_start());
  first.v_y = one.system.interface(one.system.v_start());
  System nodal;
  std::vector<std::vector<int>> y;
  for (size_t i = 0; i < nodes; ++i) {
    const PortState at = one.at(i, first);
    ModalBody mass;
    mass.name = "mass";
    const double root = std::sqrt(one.truss.mass[i]);
    mass.shapes = Matrix3d::Identity() / root;
    mass.omega_squared = mass.damping = VectorXd::Zero(3);
    mass.inertia = VectorXd::Ones(3);
    mass.rigid = MatrixXd::Zero(3, 6);
    mass.is_rotation = {0, 0, 0};
    mass.mass = one.truss.mass[i];
    mass.eta_start = root * at.position;
    mass.v_start = root * at.velocity;
    const int body = nodal.add_body(mass);
    y.push_back({nodal.coordinate(body, 0), nodal.coordinate(body, 1), nodal.coordinate(body, 2)});
  }
  for (const auto& [a, b] : one.truss.spring) {
    const auto i = static_cast<size_t>(a), j = static_cast<size_t>(b);
    nodal.add_element(std::make_unique<PairElement>(
        "spring", std::make_unique<NodePort>(Vector3d::Zero(), y[i]),
        std::make_unique<NodePort>(Vector3d::Zero(), y[j]),
        std::make_unique<LineSpring>(one.truss.stiffness, 0.0,
                                     (one.truss.node[i] - one.truss.node[j]).norm())));
  }
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-6, 1e-3, 1.0, 0.2};
  const auto floating = started(one.system, options), masses = started(nodal, options);
  while (floating->state().time < end) floating->step(end);
  while (masses->state().time < end) masses->step(end);
  double distance = 0.0, elastic = 0.0;
  for (size_t i = 0; i < nodes; ++i) {
    const Vector3d there = gather(masses->state().y, y[i]);
    distance = std::max(distance, (one.at(i, floating->state()).position - there).norm());
    elastic = std::max(elastic, (one.shape(i) * one.eta(floating->state().eta)).norm());
  }
  return distance / elastic;
}

TEST(FloatingBody, TendsToTheUnreducedMassesAndSpringsAsSpinAndStrainDecrease) {
  // Linear strains: the difference is of the order (spin / frequency)^2 and strain.
  const double fast = distance_from_nodal(4.0, 4e-4), slow = distance_from_nodal(2.0, 1e-4);
  std::printf("floating against nodal: %.1e, %.1e of the elastic displacement\n", fast, slow);
  EXPECT_LT(slow, 0.02);
  EXPECT_LT(slow, 0.4 * fast);
}

TEST(FloatingBody, InPureTranslationItIsEquationTen) {
  // A box on a spring to the ground and a mass on a spring in it, frame fixed to the box: the only
  // inertia force in the frame is - m X''.
  const double box = 3.0, mass = 2.0, inner = 5000.0, outer = 8000.0, place = 0.3;
  ElasticShapes shapes;
  shapes.mass = box + mass;
  shapes.centre = Vector3d(mass * place / shapes.mass, 0.0, 0.0);
  shapes.invariants.first = {vector(mass), vector(0.0), vector(0.0)};
  shapes.invariants.moment.fill(vector(0.0));
  shapes.invariants.moment[0] = vector(mass * place);
  shapes.invariants.product.fill(MatrixXd::Zero(1, 1));
  shapes.invariants.product[0](0, 0) = mass;
  shapes.invariants.place.diagonal() << 0.02 + mass * place * place, 0.03, 0.04;
  shapes.stiffness = MatrixXd::Constant(1, 1, inner);
  ElasticStart start;
  start.q = vector(0.01);
  const FloatingBody floating = make_floating_body("box", shapes, start);
  System system;
  const SpatialBody body = add_spatial_body(system, floating.body);
  system.add_element(std::make_unique<PairElement>(
      "outer", body.port(floating.arm(Vector3d::Zero()), floating.shape(Matrix3X::Zero(3, 1))),
      std::make_unique<GroundPort>(Vector3d::Zero()), linear_joint(outer, 0.0)));
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-5, 1e-2, 1.0, 1.0};
  const auto method = started(system, options);
  while (method->state().time < 0.5) method->step(0.5);
  const VectorXd& modal = method->state().eta;
  const auto q_of = [&](const VectorXd& all) { return floating.W(0, 0) * all(kSpatial); };
  const auto box_of = [&](const VectorXd& all) {
    return all(0) / std::sqrt(shapes.mass) - mass / shapes.mass * q_of(all);
  };
  const double q = q_of(modal), X = box_of(modal) - shapes.centre.x();
  const double q_rate2 = q_of(method->state().a), X_rate2 = box_of(method->state().a);
  // Eq. (10), and the box under its two springs.
  EXPECT_LT(std::abs(mass * q_rate2 + inner * q + mass * X_rate2), 1e-9 * inner * 0.01);
  EXPECT_LT(std::abs(box * X_rate2 + outer * X - inner * q), 1e-9 * inner * 0.01);
  // And their motion: two masses and two springs in closed form.
  Eigen::Matrix2d K, M;
  K << outer + inner, -inner, -inner, inner;
  M << box, 0.0, 0.0, mass;
  const dense::Eigenpairs exact = dense::symmetric_eigen(K, M);
  const Eigen::Vector2d at = exact.vectors.transpose() * M * Eigen::Vector2d(0.0, 0.01);
  const Eigen::Vector2d moved =
      exact.vectors * Eigen::Vector2d(at.array() * (exact.values.array().sqrt() * 0.5).cos());
  EXPECT_NEAR(X, moved(0), 1e-5);
  EXPECT_NEAR(X + q, moved(1), 1e-5);
}

TEST(FloatingBody, ASpinningBeamSoftensInItsPlaneAndIsNotStiffened) {
  // Masses m, m_0, m on a line, that bend: amplitudes 1, -2 m / m_0, 1. The tension of the spin
  // would add (1 + r) W^2, r = 2 m / m_0, to the squared frequencies w^2 across the plane of
  // rotation and w^2 - W^2 in it. That term is of the second order in the displacements: absent.
  const double m = 1.0, middle = 3.0, length = 0.5, k = 4000.0, W = 20.0, end = 0.3;
  const double share = -2.0 * m / middle, modal = 2.0 * m + middle * share * share;
  for (const int direction : {1, 2}) {
    const auto d = static_cast<size_t>(direction);
    ElasticShapes shapes;
    shapes.mass = 2.0 * m + middle;
    shapes.invariants.first.fill(vector(0.0));
    shapes.invariants.moment.fill(vector(0.0));
    shapes.invariants.product.fill(MatrixXd::Zero(1, 1));
    shapes.invariants.product[4 * d](0, 0) = modal;
    shapes.invariants.place.diagonal() << 2.0 * m * length * length, 1e-3, 1e-3;
    shapes.stiffness = MatrixXd::Constant(1, 1, k);
    ElasticStart start;
    start.frame.spin = {0.0, 0.0, W};
    start.q = vector(1e-5);
    const FloatingBody floating = make_floating_body("beam", shapes, start);
    System system;
    const SpatialBody body = add_spatial_body(system, floating.body);
    StepOptions options;
    options.largest = 1e-3;
    options.accuracy = {1e-5, 1e-5, 1e-3, 1e-3};
    const auto method = started(system, options);
    while (method->state().time < end) method->step(end);
    const double squared = k / modal - (direction == 1 ? W * W : 0.0);
    const double found = floating.W(0, 0) * method->state().eta(kSpatial);
    EXPECT_NEAR(found, 1e-5 * std::cos(std::sqrt(squared) * end), 2e-8) << direction;
    const double stiffened = squared + (1.0 - share) * W * W;
    EXPECT_GT(std::abs(found - 1e-5 * std::cos(std::sqrt(stiffened) * end)), 1e-6) << direction;
  }
}

TEST(FloatingBody, ARunResumesToTheBit) {
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-4, 1e-3, 0.1, 0.2};
  FloatingTruss one(octahedron(2e4), tumbling(1.5, 0.005, 12)), other(one.truss, {});
  const auto method = started(one.system, options);
  while (method->state().time < 0.05) method->step(0.05);
  const auto saved = one.system.element(0).save();
  const StageState state = method->state();
  const int rung = method->rung();
  method->forget_history();
  while (method->state().time < 0.1) method->step(0.1);

  const auto resumed = make_integrator(other.system, options);
  other.system.element(0).restore(saved);
  resumed->resume(state, rung);
  while (resumed->state().time < 0.1) resumed->step(0.1);
  EXPECT_EQ(resumed->state().eta, method->state().eta);
  EXPECT_EQ(resumed->state().v, method->state().v);
  EXPECT_EQ(other.body.quaternion(resumed->state()), one.body.quaternion(method->state()));
  test::expect_parts(test::refusal_of<InputError>([&] {
                       other.system.element(0).restore({1.0, 2.0});
                     }),
                     {"truss rotation: the saved state belongs to another scene"});
}

TEST(FloatingBody, ABodyWithSupportsOrWithoutInvariantsIsRefused) {
  Truss truss = octahedron(1e5);
  rom::ReducedModel held = truss.model();
  held.K_rr(0, 0) += 1e5;
  test::expect_parts(test::refusal_of<InputError>(
                         [&] { mean_axis_shapes(make_modal_body(held, {}), truss.invariants()); }),
                     {"truss: found ", " rigid modes, expected the 6"});
  test::expect_parts(test::refusal_of<InputError>(
                         [&] { mean_axis_shapes(make_modal_body(truss.model(), {}), {}); }),
                     {"truss: found no inertia invariants"});
}

}  // namespace
}  // namespace clatter::dynamics
