// SPDX-License-Identifier: GPL-3.0-or-later
// Friction in the joints of the rod: dry, by a table, of an oil film.
#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/bearing/bearing_laws.hpp"
#include "tests/dynamics/element_check.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::dynamics {
namespace {

const SliderCrank kRubbedCrank(0.065, 0.21, 0.001, CrankClock{2000.0 * std::numbers::pi / 30.0});
constexpr double kTime = 0.0031;

// Coordinates: pin y, z, rotation; rod y, z, rotation.
PairElement joint_of(std::unique_ptr<PairLaw> law) {
  PointWeights pin;
  pin.add(0, 1.0, 0.0);
  pin.add(1, 0.0, 1.0);
  pin.add_turn(2);
  return PairElement("pin", std::make_unique<WeightedPort>(pin),
                     std::make_unique<RodPort>(std::vector<int>{3, 4, 5}, kRubbedCrank,
                                               Eigen::Vector2d(0.0, 0.14)),
                     std::move(law));
}
std::unique_ptr<PairLaw> smooth_law() {
  return std::make_unique<RadialJoint>(RadialLaw{1e-5, 1e7, 1e11, 1.5, 2e4});
}
PairElement friction_joint(PinFriction friction) {
  return joint_of(std::make_unique<FrictionJoint>(smooth_law(), std::move(friction), 0));
}
PairElement journal_joint(BearingModel model = BearingModel::kMoes) {
  const BearingFilm film({.diameter = 0.04, .width = 0.03, .clearance = 2e-3, .viscosity = 0.008},
                         model);
  return joint_of(std::make_unique<ImpedanceBearing>(BearingPlace{ShaftAxes{0}}, film));
}

TEST(FrictionJoint, HasTheMomentOfCoulombOnBothSides) {
  // 40 um apart across a pin of 20 mm radius, coefficient 0.1, the rod turning by 1 rad/s more than
  // the pin: a moment of mu r N against it.
  PairElement joint = friction_joint({0.1 * 0.02, 1e-3});
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6), v = y;
  y(0) = 4e-5;
  const double ideal = kRubbedCrank.rod_angle(kTime).velocity;
  v(5) = 1.0 - ideal;
  Response response;
  // Without the damper: the rod's end rests, so its centre moves against the rotation.
  const Eigen::Vector2d end = 0.14 * rod_direction(kRubbedCrank.rod_angle(kTime).position);
  v(3) = end.y() * v(5);
  v(4) = -end.x() * v(5);
  joint.evaluate({kTime, 1e-6, 1, {}}, y, v, false, response);
  const RadialLaw law{1e-5, 1e7, 1e11, 1.5, 2e4};
  const double load = law.force(4e-5);
  EXPECT_NEAR(response.force(2), 0.1 * 0.02 * load, 1e-5 * load * 0.002);
  const double lever = end.x() * response.force(4) - end.y() * response.force(3);
  EXPECT_NEAR(response.force(5) - lever, -0.1 * 0.02 * load, 1e-5 * load * 0.002);
}

TEST(FrictionJoint, TangentAndPowerAreExact) {
  const RisingTable table({0.0, 500.0, 2000.0, 2e4}, {0.0, 2.0, 5.0, 30.0});
  for (const PinFriction& friction : {PinFriction{0.004, 0.5}, PinFriction{table, 30.0}}) {
    PairElement joint = friction_joint(friction);
    const Eigen::VectorXd y = 2e-5 * test::random_vector(6, 3),
                          before = 2e-5 * test::random_vector(6, 4);
    EXPECT_LT(testing::tangent_error(joint, {kTime, 3e-6, 1, {}}, y, before, 1e-10), 1e-7);
    EXPECT_LT(testing::power_error(joint, kTime, y, 0.3 * test::random_vector(6, 5), 1e-9), 1e-9);
  }
}

TEST(FrictionJoint, WithoutFrictionIsTheJoint) {
  PairElement with = friction_joint({0.0, 0.5}), without = joint_of(smooth_law());
  const Eigen::VectorXd y = 2e-5 * test::random_vector(6, 1), v = 0.2 * test::random_vector(6, 2);
  const Stage stage{kTime, 2e-6, 1, {}};
  Response a, b;
  with.evaluate(stage, y, v, true, a);
  without.evaluate(stage, y, v, true, b);
  EXPECT_EQ((a.force - b.force).norm(), 0.0);
  EXPECT_EQ((a.tangent - b.tangent).norm(), 0.0);
  EXPECT_EQ(a.force(2), 0.0);
}

TEST(FilmJoint, IsPetroffsBearingWhenCentred) {
  PairElement joint = journal_joint();
  Response response;
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  joint.evaluate({kTime, 1e-6, 1, {}}, rest, rest, false, response);
  const double swing = kRubbedCrank.rod_angle(kTime).velocity;
  // pi mu b d^2 w / (2 psi) on the pin, in the direction of the rod's rotation.
  const double petroff = std::numbers::pi * 0.008 * 0.03 * 0.04 * 0.04 * swing / (2.0 * 2e-3);
  EXPECT_NEAR(response.force(2), petroff, 1e-9 * std::abs(petroff));
  EXPECT_NEAR(response.force(5), -petroff, 1e-9 * std::abs(petroff));
}

TEST(FilmJoint, TangentAndPowerAreExact) {
  for (const BearingModel model : {BearingModel::kMoes, BearingModel::kButenschoen}) {
    PairElement joint = journal_joint(model);
    Eigen::VectorXd y = 6e-6 * test::random_vector(6, 3);
    y(5) *= 10.0;  // the rod's rotation
    const Eigen::VectorXd before = y - 2e-8 * test::random_vector(6, 9);
    EXPECT_LT(testing::tangent_error(joint, {kTime, 3e-6, 1, {}}, y, before, 3e-11), 1e-6);
    EXPECT_LT(testing::power_error(joint, kTime, y, 0.02 * test::random_vector(6, 5), 1e-9), 1e-12);
  }
}

TEST(FilmJoint, ForcesAndMomentsOfBothSidesCancel) {
  PairElement joint = journal_joint();
  Eigen::VectorXd y = 8e-6 * test::random_vector(6, 3), v = 0.02 * test::random_vector(6, 5);
  y(5) = 0.0;  // the rod's rotation: its end is at its ideal position, moved by its centre
  Response response;
  joint.evaluate({kTime, 1e-6, 1, {}}, y, v, false, response);
  const auto f = [&](int coordinate) { return response.force(coordinate); };
  EXPECT_GT(std::hypot(f(0), f(1)), 1.0);
  EXPECT_NEAR(f(0) + f(3), 0.0, 1e-12 * std::abs(f(0)));
  EXPECT_NEAR(f(1) + f(4), 0.0, 1e-12 * std::abs(f(1)));
  // About the bearing's centre: the force on the pin acts at the pin's, d away.
  const Eigen::Vector2d end = 0.14 * rod_direction(kRubbedCrank.rod_angle(kTime).position);
  const double on_rod = f(5) - (end.x() * f(4) - end.y() * f(3));
  const double couple = (y(0) - y(3)) * f(1) - (y(1) - y(4)) * f(0);
  EXPECT_NEAR(f(2) + on_rod + couple, 0.0, 1e-9 * std::abs(couple) + 1e-12 * std::abs(f(5)));
  EXPECT_GT(std::abs(couple), 1e-6);
}

TEST(FilmJoint, SeesTheMeanRotationOfPinAndRod) {
  // Pin and rod turning at w in opposite directions carry nothing; both at w carry as one at 2 w
  // against one at rest: the wedge has the mean of both speeds.
  PairElement joint = journal_joint();
  const double ideal = kRubbedCrank.rod_angle(kTime).velocity;
  const auto force = [&](double pin, double rod) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(6), v = y;
    y(0) = 2e-5;
    v(2) = pin;
    v(5) = rod - ideal;
    const Eigen::Vector2d end = 0.14 * rod_direction(kRubbedCrank.rod_angle(kTime).position);
    v(3) = end.y() * v(5);
    v(4) = -end.x() * v(5);
    Response response;
    joint.evaluate({kTime, 1e-6, 1, {}}, y, v, false, response);
    return Eigen::Vector2d(response.force.head<2>());
  };
  const double both = force(50.0, 50.0).norm();
  EXPECT_GT(both, 10.0);
  EXPECT_NEAR(force(100.0, 0.0).norm(), both, 1e-6 * both);
  EXPECT_NEAR(force(0.0, 100.0).norm(), both, 1e-6 * both);
  EXPECT_LT(force(50.0, -50.0).norm(), 1e-2 * both);
}

}  // namespace
}  // namespace clatter::dynamics
