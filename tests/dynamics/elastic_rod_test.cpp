// SPDX-License-Identifier: GPL-3.0-or-later
// The elastic rod and the rod without mass: forces, tangents, powers.
#include "dynamics/body/elastic_rod.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/element/rod_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/element/massless_rod.hpp"
#include "dynamics/element/pin_guide.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "tests/dynamics/rod_truss.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

const SliderCrank kRodCrank(0.065, testing::kRodLength, 0.001,
                            CrankClock{2000.0 * std::numbers::pi / 30.0});
constexpr double kRodTime = 0.0031;

struct TrussRod {
  explicit TrussRod(double skew) : truss(testing::rod_truss(2e8, skew)) {
    const rom::ReducedModel model = testing::rod_model(truss);
    rod = make_elastic_rod(model, make_modal_body(model, {}));
  }
  int motions() const { return static_cast<int>(rod.shapes.cols()); }

  testing::Truss truss;
  ElasticRod rod;
};

TEST(ElasticRod, MotionsHaveNoMassInCommonAndGiveTheRigidOnesBack) {
  const TrussRod one(0.5);
  const ModalBody& body = one.rod.body;
  const rom::ReducedModel model = testing::rod_model(one.truss);
  const Eigen::MatrixXd M = one.rod.shapes.transpose() * model.M_rr * one.rod.shapes;
  EXPECT_LT((M - Eigen::MatrixXd::Identity(one.motions(), one.motions())).norm(), 1e-12);
  // Nor with the three of the plane: y, z and the rotation about x through the centre of mass.
  for (size_t i = 0; i < one.truss.node.size(); ++i) ASSERT_TRUE(one.truss.mass[i] > 0.0);
  Eigen::Matrix<double, Eigen::Dynamic, 3> planar(model.size(), 3);
  planar.leftCols<2>() = model.rigid.middleCols<2>(1);
  planar.col(2) =
      model.rigid.col(3) + model.rigid.leftCols<3>() * one.rod.centre.cross(Vector3d::UnitX());
  EXPECT_LT((planar.transpose() * model.M_rr * one.rod.shapes).norm(), 1e-12);
  // mass and inertia by the sums over the masses.
  double mass = 0.0, inertia = 0.0;
  for (size_t i = 0; i < one.truss.node.size(); ++i) {
    mass += one.truss.mass[i];
    inertia += one.truss.mass[i] * (one.truss.node[i] - one.rod.centre).tail<2>().squaredNorm();
  }
  EXPECT_NEAR(body.mass, mass, 1e-13);
  EXPECT_NEAR(one.rod.inertia, inertia, 1e-14);
  const Eigen::MatrixXd gram = body.rigid.transpose() * body.rigid;
  EXPECT_NEAR(gram(3, 3), inertia, 1e-14);
  EXPECT_NEAR(gram(0, 0), mass, 1e-12);
}

/// Inertia forces on the rotation theta and the motions zeta, as sums over point masses: every mass
/// is at c(t) + R(phi + theta) (x + u), its acceleration differentiated by hand.
VectorXd forces_of_masses(const TrussRod& one, double theta, double theta_rate,
                          const VectorXd& zeta, const VectorXd& zeta_rate) {
  const Motion<double> phi = kRodCrank.rod_angle(kRodTime);
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(phi.position + theta, Vector3d::UnitX()).toRotationMatrix();
  const Vector3d w(phi.velocity + theta_rate, 0.0, 0.0), w_rate(phi.acceleration, 0.0, 0.0);
  VectorXd force = VectorXd::Zero(1 + zeta.size());
  for (size_t i = 0; i < one.truss.node.size(); ++i) {
    const Eigen::MatrixXd N = one.rod.shapes.middleRows<3>(static_cast<Eigen::Index>(3 * i));
    const Vector3d p = one.truss.node[i] - one.rod.centre + N * zeta, rate = N * zeta_rate;
    const Vector3d a = w_rate.cross(p) + w.cross(w.cross(p)) + 2.0 * w.cross(rate);
    force.tail(zeta.size()) -= one.truss.mass[i] * (N.transpose() * a);
    force(0) -= one.truss.mass[i] * (R * Vector3d::UnitX().cross(p)).dot(R * a);
  }
  force(0) /= std::sqrt(one.rod.inertia);
  return force;
}

TEST(ElasticRod, InertiaForcesAreThoseOfItsPointMassesToFirstOrder) {
  // What is left falls with the square of the deviations: 4 for each halving.
  for (const double skew : {0.0, 0.5}) {
    const TrussRod one(skew);
    const int n = one.motions();
    std::vector<int> y;
    for (int k = 0; k <= n; ++k) y.push_back(k);
    RodFrame frame("rod frame", y, one.rod.coupling, kRodCrank);
    const Motion<double> phi = kRodCrank.rod_angle(kRodTime);
    VectorXd load = VectorXd::Zero(1 + n);
    load(0) = -std::sqrt(one.rod.inertia) * phi.acceleration;
    load.tail(n) = phi.velocity * phi.velocity * one.rod.coupling.stretch;
    const VectorXd at = test::random_vector(1 + n, 3), rate = test::random_vector(1 + n, 4);
    std::vector<double> left;
    for (const double size : {4e-5, 2e-5, 1e-5}) {
      const VectorXd q = size * at, v = 1e3 * size * rate;
      const double root = std::sqrt(one.rod.inertia);
      const VectorXd expected =
          forces_of_masses(one, q(0) / root, v(0) / root, q.tail(n), v.tail(n)) - load;
      Response response;
      frame.evaluate({kRodTime, 1e-6, 1, {}}, q, v, false, response);
      left.push_back((response.force - expected).norm() / size);
      EXPECT_LT((response.force - expected).norm(), 1e-2 * expected.norm()) << size;
    }
    EXPECT_NEAR(left[0] / left[1], 2.0, 0.02) << skew;
    EXPECT_NEAR(left[1] / left[2], 2.0, 0.02) << skew;
  }
}

TEST(ElasticRod, TangentOfItsFrameIsThatOfTheForces) {
  const TrussRod one(0.5);
  const int n = one.motions();
  std::vector<int> y;
  for (int k = 0; k <= n; ++k) y.push_back(k);
  RodFrame frame("rod frame", y, one.rod.coupling, kRodCrank);
  const Stage stage{kRodTime, 2e-6, 1, {}};
  Response response, other;
  const VectorXd zero = VectorXd::Zero(1 + n), step = test::random_vector(1 + n, 8);
  frame.evaluate(stage, zero, zero, true, response);
  EXPECT_EQ(response.force.norm(), 0.0);
  frame.evaluate(stage, step, step / stage.kappa, false, other);
  EXPECT_LT((other.force - response.tangent * step).norm(), 1e-12 * other.force.norm());
}

TEST(ElasticRod, IsRefusedWithoutInvariantsOrWithSupports) {
  rom::ReducedModel model = testing::rod_model(testing::rod_truss(1e8));
  const ModalBody free = make_modal_body(model, {});
  model.inertia = {};
  EXPECT_THROW(make_elastic_rod(model, free), InputError);
  model = testing::rod_model(testing::rod_truss(1e8));
  model.K_rr(0, 0) += 1e9;
  EXPECT_THROW(make_elastic_rod(model, make_modal_body(model, {})), InputError);
}

const RadialLaw kRodLaw{1e-5, 1e7, 1e11, 1.5, 2e4};

/// Joint of a pin (coordinates 0, 1) and an end of the elastic rod (2 .. 6).
PairElement elastic_joint() {
  PointWeights pin;
  pin.add(0, 1.0, 0.0);
  pin.add(1, 0.0, 1.0);
  return PairElement(
      "pin", std::make_unique<WeightedPort>(pin),
      std::make_unique<RodPort>(std::vector<int>{2, 3, 4, 5, 6}, kRodCrank, Vector2d(0.003, 0.14)),
      std::make_unique<RadialJoint>(kRodLaw));
}

std::unique_ptr<MasslessRod> massless() {
  PointWeights pin, centre;
  for (PointWeights* point : {&pin, &centre}) {
    point->add(0, 1.0, 0.0);
    point->add(1, 0.0, 1.0);
  }
  const auto joint = [](const char* name, const PointWeights& point, double arm) {
    return std::make_unique<PairElement>(
        name, std::make_unique<WeightedPort>(point),
        std::make_unique<RodPort>(std::vector<int>{0, 1, 2}, kRodCrank, Vector2d(0.0, arm)),
        std::make_unique<RadialJoint>(kRodLaw));
  };
  auto at_pin = joint("pin", pin, 0.14), at_crank = joint("crank_pin", centre, -0.07);
  return std::make_unique<MasslessRod>("rod", std::move(at_pin), std::move(at_crank));
}

/// Largest error of an element's tangent against central differences, relative.
double tangent_error(ForceElement& element, const VectorXd& y, const VectorXd& before) {
  const Stage stage{kRodTime, 2e-6, 1, {2e-6}};
  element.begin_step(kRodTime - 4e-6);
  Response at, plus, minus;
  element.evaluate(stage, y, (y - before) / stage.kappa, true, at);
  double worst = 0.0;
  for (Eigen::Index j = 0; j < y.size(); ++j) {
    const double h = 1e-9;
    VectorXd a = y, b = y;
    a(j) += h;
    b(j) -= h;
    element.evaluate(stage, a, (a - before) / stage.kappa, false, plus);
    element.evaluate(stage, b, (b - before) / stage.kappa, false, minus);
    const VectorXd column = (plus.force - minus.force) / (2.0 * h);
    worst = std::max(worst, (column - at.tangent.col(j)).norm() / at.tangent.norm());
  }
  return worst;
}

TEST(ElasticRod, TangentsOfItsEndAndItsGuideMatchDifferences) {
  PairElement joint = elastic_joint();
  EXPECT_LT(
      tangent_error(joint, 2e-5 * test::random_vector(7, 3), 2e-5 * test::random_vector(7, 4)),
      1e-10);
  GuidePath path;
  path.point = [](double t) { return kRodCrank.rod_point(t, 0.07); };
  path.turn = [](double t) { return kRodCrank.rod_angle(t); };
  PinGuide guide("rod_guide", {}, path, {0, 1, 2}, std::array{3, 4, 5});
  EXPECT_LT(
      tangent_error(guide, 2e-5 * test::random_vector(6, 5), 2e-5 * test::random_vector(6, 6)),
      1e-10);
}

/// force . v + d(stored)/dt + lost - input over the largest of them, along y + (t - kRodTime) v.
double power_left(ForceElement& element, const VectorXd& y, const VectorXd& v) {
  const double h = 1e-8;
  Response response;
  const auto at = [&](double time) {
    element.evaluate({time, 1e-6, 1, {}}, y + (time - kRodTime) * v, v, false, response);
    element.finish_stage({time, 1e-6, 1, {}});
    return element.power(y + (time - kRodTime) * v, v);
  };
  const double rate = (at(kRodTime + h).stored - at(kRodTime - h).stored) / (2.0 * h);
  const Power power = at(kRodTime);
  const double work = response.force.dot(v);
  EXPECT_NE(power.input, 0.0);
  return std::abs(work + rate + power.lost - power.input) /
         (std::abs(work) + std::abs(rate) + std::abs(power.input));
}

TEST(ElasticRod, PowersOfItsEndAndItsGuideBalance) {
  PairElement joint = elastic_joint();
  EXPECT_LT(power_left(joint, 3e-5 * test::random_vector(7, 5), 0.3 * test::random_vector(7, 6)),
            1e-6);
  GuidePath path;
  path.point = [](double t) { return kRodCrank.rod_point(t, 0.07); };
  path.turn = [](double t) { return kRodCrank.rod_angle(t); };
  PinGuide guide("rod_guide", {}, path, {0, 1, 2}, std::array{3, 4, 5});
  EXPECT_LT(power_left(guide, 3e-5 * test::random_vector(6, 5), 0.3 * test::random_vector(6, 6)),
            1e-6);
}

TEST(ElasticRod, ItsEndWithoutDisplacementIsThatOfARigidRod) {
  RodPort rigid({0, 1, 2}, kRodCrank, Vector2d(0.0, 0.14));
  RodPort elastic({0, 1, 2, 3, 4}, kRodCrank, Vector2d(0.0, 0.14));
  VectorXd y = VectorXd::Zero(5), v = VectorXd::Zero(5);
  y.head<3>() = 3e-5 * test::random_vector(3, 1);
  v.head<3>() = 0.2 * test::random_vector(3, 2);
  PortState a, b;
  rigid.motion(kRodTime, y.head(3), v.head(3), a);
  elastic.motion(kRodTime, y, v, b);
  EXPECT_LT((a.position - b.position).norm(), 1e-14 * a.position.norm());
  EXPECT_LT((a.velocity - b.velocity).norm(), 1e-13 * a.velocity.norm());
  EXPECT_LT((a.driven - b.driven).norm(), 1e-14 * a.velocity.norm());
  EXPECT_LT((a.by_y - b.by_y.leftCols<3>()).norm(), 1e-15);
  EXPECT_LT((a.rate_by_y - b.rate_by_y.leftCols<3>()).norm(), 1e-12 * a.rate_by_y.norm());
}

TEST(MasslessRod, ItsForceIsAlongTheLineOfItsEndsAndTheSameAtBoth) {
  const auto rod = massless();
  rod->begin_step(kRodTime);
  const VectorXd y = 2e-4 * test::random_vector(4, 2);
  Response response;
  // A long stage: what moves has come to rest, so that the joints' forces are those of their laws.
  rod->evaluate({kRodTime, 1e6, 0, {}}, y, VectorXd::Zero(4), false, response);
  const Vector2d at_pin = response.force.head<2>(), at_crank = response.force.tail<2>();
  EXPECT_GT(at_pin.norm(), 50.0);
  EXPECT_LT((at_pin + at_crank).norm(), 1e-9 * at_pin.norm());
  const Motion<double> phi = kRodCrank.rod_angle(kRodTime);
  const Vector2d line =
      testing::kRodLength * rod_direction(phi.position) + y.head<2>() - y.tail<2>();
  const double across = at_pin.x() * line.y() - at_pin.y() * line.x();
  // 1e-8: d and d' over a long stage are rounded at 1e-16 of the rod's length.
  EXPECT_LT(std::abs(across), 1e-7 * at_pin.norm() * line.norm());
}

TEST(MasslessRod, TangentMatchesDifferences) {
  const auto rod = massless();
  EXPECT_LT(tangent_error(*rod, 2e-5 * test::random_vector(4, 3), 2e-5 * test::random_vector(4, 4)),
            1e-7);
}

TEST(MasslessRod, ContinuesFromASavedStateToTheBit) {
  const auto rod = massless(), other = massless();
  const VectorXd y = 2e-5 * test::random_vector(4, 3), v = 0.1 * test::random_vector(4, 4);
  Response a, b;
  double time = kRodTime;
  for (const double weight : {0.0, 3e-6}) {
    const Stage stage{time += 1e-5, 1e-5, weight > 0.0 ? 1 : 0,
                      weight > 0.0 ? std::vector{weight} : std::vector<double>{}};
    rod->begin_step(time);
    rod->evaluate(stage, y, v, false, a);
    rod->finish_stage(stage);
    rod->accept_step(time);
  }
  other->restore(rod->save());
  const Stage next{time + 1e-5, 1e-5, 1, {2e-6}};
  for (const auto& [element, response] : {std::pair{rod.get(), &a}, {other.get(), &b}}) {
    element->begin_step(time);
    element->evaluate(next, y, v, false, *response);
  }
  EXPECT_EQ(a.force, b.force);
  EXPECT_THROW(other->restore({1.0}), InputError);
}

}  // namespace
}  // namespace clatter::dynamics
