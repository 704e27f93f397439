// SPDX-License-Identifier: GPL-3.0-or-later
// Discs, their ports, beams and bearings: derivatives, balance, energy.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/body/rotation.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "dynamics/shaft/disc_gyroscope.hpp"
#include "dynamics/shaft/disc_port.hpp"
#include "dynamics/shaft/shaft_beam.hpp"
#include "dynamics/shaft/torsion_spring.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::arbitrary;
using testing::tangent_error;

const Vector3d kCentre(0.1, -0.2, 0.3), kArm(0.05, 0.02, -0.03);

std::unique_ptr<Port> disc_port(int axis, int first, const Vector3d& arm = kArm) {
  std::vector<int> six;
  for (int k = 0; k < 6; ++k) six.push_back(first + k);
  return std::make_unique<DiscPort>(six, ShaftAxes{axis}, kCentre, arm);
}

TEST(DiscPort, RatesAreThoseOfThePosition) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto port = disc_port(axis, 0);
    const VectorXd y = arbitrary(6, 1), v = arbitrary(6, 2);
    PortState at, later, before;
    port->motion(0.0, y, v, at);
    const double h = 1e-6;
    port->motion(0.0, y + h * v, v, later);
    port->motion(0.0, y - h * v, v, before);
    EXPECT_LT(((later.position - before.position) / (2.0 * h) - at.velocity).norm(), 1e-9);
    EXPECT_LT((at.by_y.topRows<3>() * v - at.velocity).norm(), 1e-14);
    // Power of force and moment is that of the forces on the coordinates.
    const Vector6 wrench = arbitrary(6, 3);
    EXPECT_NEAR((at.work.transpose() * wrench).dot(v),
                wrench.head<3>().dot(at.velocity) + wrench.tail<3>().dot(at.spin), 1e-14);
  }
}

TEST(DiscPort, IsARigidBodyToFirstOrderInTilt) {
  const auto port = disc_port(2, 0);
  for (const double tilt : {1e-2, 1e-3}) {
    VectorXd y = arbitrary(6, 4), v = arbitrary(6, 5);
    y.segment<2>(3) *= tilt;
    v.segment<2>(3) *= tilt;
    y(5) = 2.0;
    v(5) = 3.0;
    PortState at;
    port->motion(0.0, y, v, at);
    const Eigen::Matrix3d R = at.rotation;
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).norm(), 3.0 * tilt * tilt);
    EXPECT_LT((kCentre + y.head<3>() + R * kArm - at.position).norm(), 1e-15);
    EXPECT_LT((v.head<3>() + at.spin.cross(R * kArm) - at.velocity).norm(), 0.5 * tilt * tilt);
  }
}

TEST(ShaftParts, TangentsAreDifferenceQuotients) {
  // On two discs, on a disc that only turns, on the ground.
  PairElement two("b", disc_port(0, 0), disc_port(0, 6, Vector3d(0.01, 0.0, 0.02)),
                  linear_joint(3.0, 0.7));
  EXPECT_LT(tangent_error(two, arbitrary(12, 1), arbitrary(12, 2)), 1e-8);
  PairElement turning(
      "b", std::make_unique<DiscPort>(std::vector<int>{0}, ShaftAxes{1}, kCentre, kArm),
      std::make_unique<GroundPort>(Vector3d(0.2, 0.0, 0.0)), linear_joint(3.0, 0.7));
  EXPECT_LT(tangent_error(turning, arbitrary(1, 1), arbitrary(1, 2)), 1e-8);
  DiscGyroscope gyroscope("g", {0, 1, 2}, 0.3);
  EXPECT_LT(tangent_error(gyroscope, arbitrary(3, 1), arbitrary(3, 2)), 1e-8);
  ShaftFlexibility piece;
  piece.bending << 1.0, 0.4, 0.4, 0.5;
  piece.torsion = 0.3;
  piece.axial = 0.7;
  std::vector<int> twelve;
  for (int k = 0; k < 12; ++k) twelve.push_back(k);
  for (int axis = 0; axis < 3; ++axis) {
    ShaftBeam beam("s", twelve, ShaftAxes{axis}, {0.4, 0.1, -0.05}, piece, 0.2);
    EXPECT_LT(tangent_error(beam, arbitrary(12, 1), arbitrary(12, 2)), 1e-8);
  }
  TorsionSpring spring("t", 0, 1, {2.0, 0.1, 0.2});
  EXPECT_LT(tangent_error(spring, arbitrary(2, 1), arbitrary(2, 2)), 1e-8);
}

TEST(ShaftParts, ABeamBalancesForceAndMomentAndLosesWhatItSays) {
  const ShaftSections steel({{0.0, 0.4, 0.024, 0.0}}, {});
  std::vector<int> twelve;
  for (int k = 0; k < 12; ++k) twelve.push_back(k);
  const double length = 0.2, arm_i = 0.03, arm_j = -0.02;
  ShaftBeam beam("s", twelve, ShaftAxes{2}, {length, arm_i, arm_j}, steel.flexibility(0.0, length),
                 1e-5);
  VectorXd y = 1e-4 * arbitrary(12, 1), v = arbitrary(12, 2);
  v(5) = 200.0;
  v(11) = 201.0;
  Response response;
  const Stage stage{0.0, 1e-5, 1, {}};
  beam.evaluate(stage, y, v, false, response);
  const VectorXd& f = response.force;
  // From the centre of disc i to that of j.
  const Vector3d between(0.0, 0.0, arm_i + length - arm_j);
  const Vector3d moment = f.segment<3>(3) + f.segment<3>(9) + between.cross(f.segment<3>(6));
  EXPECT_LT((f.head<3>() + f.segment<3>(6)).norm(), 1e-12 * f.head<3>().norm());
  EXPECT_LT(moment.head<2>().norm(), 1e-11 * f.segment<2>(3).norm());
  // About the axis the balance is of second order: the bent shaft's damping against its rotation.
  const Power power = beam.power(y, v);
  const double h = 1e-7;
  const double stored =
      (beam.power(y + h * v, v).stored - beam.power(y - h * v, v).stored) / (2 * h);
  EXPECT_NEAR(f.dot(v), -stored - power.lost, 1e-7 * power.lost);
  EXPECT_GT(power.lost, 0.0);
  // Rigid motions: along, and a small turn about a point of the axis.
  VectorXd rigid = VectorXd::Zero(12);
  const Vector3d turn(2e-3, -1e-3, 0.7), shift(0.1, 0.2, 0.3);
  rigid << shift, turn, shift + Vector3d(turn.x(), turn.y(), 0.0).cross(between), turn;
  beam.evaluate(stage, rigid, VectorXd::Zero(12), false, response);
  EXPECT_LT(response.force.norm(), 1e-12 * beam.power(rigid + y, v).stored / 1e-4);
}

TEST(ShaftParts, AnAxialMomentKeepsTheAxisOfATiltedDisc) {
  // A disc that is tilted and speeds up by a moment along its own axis: the axis stays.
  const auto port = disc_port(2, 0, Vector3d::Zero());
  VectorXd y = VectorXd::Zero(6), v = VectorXd::Zero(6);
  y(3) = 0.01;
  y(4) = -0.02;
  PortState at;
  port->motion(0.0, y, v, at);
  Vector6 wrench = Vector6::Zero();
  wrench.tail<3>() = Vector3d::UnitZ() + Vector3d(y(3), y(4), 0.0).cross(Vector3d::UnitZ());
  const VectorXd force = at.work.transpose() * wrench;
  EXPECT_LT(force.segment<2>(3).norm(), 1e-15);
  EXPECT_NEAR(force(5), 1.0, 1e-3);
}

/// A bearing between a disc and a rigid body in space or in the plane.
void expect_balance(std::unique_ptr<PairLaw> law) {
  // Journal: six coordinates at its centre; housing: a planar body about a point beside it.
  auto journal = std::make_unique<DiscPort>(std::vector<int>{0, 1, 2, 3, 4, 5}, ShaftAxes{2},
                                            Vector3d::Zero(), Vector3d::Zero());
  auto housing =
      std::make_unique<PlanarPort>(std::vector<int>{6, 7, 8}, Eigen::Vector2d(-0.3, 0.1));
  PairElement bearing("b", std::move(journal), std::move(housing), std::move(law));
  VectorXd y = VectorXd::Zero(9), v = VectorXd::Zero(9);
  y.head<6>() << 8e-6, -5e-6, 0.0, 0.0, 0.0, 1.3;
  y.tail<3>() << 0.3 + 2e-6, -0.1 + 3e-6, 1e-5;
  v << 1e-3, 2e-3, 0.0, 0.0, 0.0, 180.0, -2e-3, 1e-3, 4.0;
  v(6) += 0.1 * v(8);
  v(7) += 0.3 * v(8);
  Response response;
  const Stage stage{0.0, 1e-5, 1, {}};
  bearing.evaluate(stage, y, v, true, response);
  const VectorXd f = response.force;
  EXPECT_GT(f.head<2>().norm(), 1.0);
  EXPECT_LT((f.head<2>() + f.segment<2>(6)).norm(), 1e-13 * f.head<2>().norm());
  // Moments about the scene's origin.
  const double on_journal = f(5) + y(0) * f(1) - y(1) * f(0),
               on_housing = f(8) + y(6) * f(7) - y(7) * f(6);
  EXPECT_NEAR(on_journal + on_housing, 0.0, 1e-13 * f.head<2>().norm());
  const double h = 1e-7;
  // The same motion, seen from a ground that moves and turns slowly with the housing.
  EXPECT_LT((response.tangent.row(0) + response.tangent.row(6)).norm(),
            1e-10 * response.tangent.row(0).norm());
  const auto power = [&](const VectorXd& at) {
    bearing.evaluate(stage, at, v, false, response);
    bearing.finish_stage(stage);
    return bearing.power(at, v);
  };
  const double storing = (power(y + h * v).stored - power(y - h * v).stored) / (2.0 * h);
  EXPECT_NEAR(f.dot(v), -power(y).lost - storing, 1e-6 * std::abs(f.dot(v)));
}

TEST(ShaftParts, ABearingOnAMovingHousingBalancesForceMomentAndPower) {
  const BearingSize size{24e-3, 16e-3, 2e-3, 10e-3};
  const BearingPlace z{ShaftAxes{2}};
  for (const BearingModel model : {BearingModel::kButenschoen, BearingModel::kMoes})
    expect_balance(std::make_unique<ImpedanceBearing>(z, BearingFilm(size, model)));
  expect_balance(std::make_unique<RadialBearing>(z, RadialLaw{0.0, 1e7, 0.0, 1.0, 1e3}));
}

TEST(ShaftParts, BearingTangentsAreDifferenceQuotients) {
  // Of a size for which differences of 1e-6 are small: 1 m, clearance 0.5.
  const BearingSize size{1.0, 0.5, 1.0, 0.3};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, w = (axis + 2) % 3;
    const PlaneAxes plane{kCentre - kCentre(u) * Vector3d::Unit(u) - kCentre(w) * Vector3d::Unit(w),
                          Vector3d::Unit(u), Vector3d::Unit(w)};
    const auto housing = [&] {
      return std::make_unique<PlanarPort>(std::vector<int>{6, 7, 8}, Eigen::Vector2d(0.02, -0.01),
                                          plane);
    };
    VectorXd y = 0.05 * arbitrary(9, 1);
    y.tail<3>() += Vector3d(kCentre(u), kCentre(w), 0.4);
    const VectorXd v = arbitrary(9, 2);
    for (const BearingModel model : {BearingModel::kButenschoen, BearingModel::kMoes}) {
      PairElement bearing("b", disc_port(axis, 0, Vector3d(0.01, 0.02, 0.01)), housing(),
                          std::make_unique<ImpedanceBearing>(
                              BearingPlace{ShaftAxes{axis}, Vector3d::Constant(0.01), {2.0, 0.1}},
                              BearingFilm(size, model)));
      EXPECT_LT(tangent_error(bearing, y, v), 1e-6) << axis;
    }
    PairElement linear(
        "b", disc_port(axis, 0), housing(),
        std::make_unique<RadialBearing>(BearingPlace{ShaftAxes{axis}, Vector3d::Zero(), {2.0, 0.1}},
                                        RadialLaw{0.0, 3.0, 0.0, 1.0, 0.5}));
    EXPECT_LT(tangent_error(linear, y, v), 1e-7) << axis;
  }
}

}  // namespace
}  // namespace clatter::dynamics
