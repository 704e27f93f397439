// SPDX-License-Identifier: GPL-3.0-or-later
// Joints of a chain.
#include "dynamics/chain/link_joints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/chain/chain_spec.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::arbitrary;

ChainMake make(int links) {
  ChainMake made;
  for (int j = 0; j < links; ++j) {
    made.kinds.push_back(j % 2 == 0 ? LinkKind::kInner : LinkKind::kOuter);
    made.pitches.push_back(8e-3);
  }
  made.inner = made.outer = {2.4e-3, 4.4e-8};
  return made;
}

std::vector<int> numbered(int n) {
  std::vector<int> all;
  for (int k = 0; k < n; ++k) all.push_back(k);
  return all;
}

/// Pins on a regular polygon, its links [m].
VectorXd ring(int links, double pitch) {
  const double radius = 0.5 * pitch / std::sin(std::numbers::pi / links);
  std::vector<Vector2d> pins;
  for (int j = 0; j < links; ++j)
    pins.push_back(radius * Vector2d(std::cos(2.0 * std::numbers::pi * j / links),
                                     std::sin(2.0 * std::numbers::pi * j / links)));
  VectorXd y(3 * links);
  const std::vector<LinkPlace> places = links_between(pins);
  for (int j = 0; j < links; ++j) {
    y.segment<2>(3 * j) = places[j].centre;
    y(3 * j + 2) = places[j].angle;
  }
  return y;
}

LinkJoints joints(int links, const JointLaw& law) {
  return {"chain", numbered(3 * links), make(links), law};
}

TEST(LinkJoints, TangentsAreTheDifferenceQuotientsOfTheForces) {
  JointLaw law;
  law.clearance = 1e-5;
  law.friction = 0.1;
  law.slip_speed = 0.5;
  LinkJoints chain = joints(5, law);
  // Joints of some 30 um and some m/s; one inside its clearance.
  VectorXd y = ring(5, 8e-3) + 2e-5 * arbitrary(15, 1);
  y(3) = ring(5, 8e-3)(3);
  // Differences of 1e-9 m of a force whose direction turns over 1e-5 m: 1e-8 of it.
  EXPECT_LT(testing::tangent_error(chain, y, arbitrary(15, 2), 1e-9, 1e-5), 1e-6);
}

TEST(LinkJoints, ForcesAndMomentsBalance) {
  JointLaw law;
  law.friction = 0.1;
  LinkJoints chain = joints(6, law);
  const VectorXd y = ring(6, 8e-3) + 2e-5 * arbitrary(18, 1), v = arbitrary(18, 2);
  Response response;
  chain.evaluate({0.0, 1e-5, 1, {}}, y, v, false, response);
  Vector2d force = Vector2d::Zero();
  double moment = 0.0, size = 0.0;
  for (int j = 0; j < 6; ++j) {
    const Vector2d f = response.force.segment<2>(3 * j), at = y.segment<2>(3 * j);
    force += f;
    moment += response.force(3 * j + 2) + at.x() * f.y() - at.y() * f.x();
    size += f.norm();
  }
  EXPECT_LT(force.norm(), 1e-14 * size);
  EXPECT_LT(std::abs(moment), 1e-14 * size);
}

TEST(LinkJoints, WorkOnTheLinksIsWhatIsStoredAndLost) {
  JointLaw law;
  law.friction = 0.1;
  law.clearance = 5e-6;
  LinkJoints chain = joints(6, law);
  const VectorXd y = ring(6, 8e-3) + 2e-5 * arbitrary(18, 1), v = arbitrary(18, 2);
  Response response;
  chain.evaluate({0.0, 1e-5, 1, {}}, y, v, false, response);
  const double h = 1e-9;
  const double storing =
      (chain.power(y + h * v, v).stored - chain.power(y - h * v, v).stored) / (2.0 * h);
  const double work = response.force.dot(v), lost = chain.power(y, v).lost;
  EXPECT_GT(lost, 0.0);
  // The stored energy's third derivative over h^2.
  EXPECT_NEAR(work, -storing - lost, 1e-6 * (std::abs(work) + lost));
}

TEST(LinkJoints, SayHowFarPinsThatArePressedCreep) {
  JointLaw law;
  law.friction = 0.1;
  LinkJoints chain = joints(6, law);
  const VectorXd y = 1.001 * ring(6, 8e-3);  // pulled apart
  VectorXd v = VectorXd::Zero(18);
  v(5) = 2.0;  // one link turns, 3.3 mm/s in both of its joints
  Response response;
  chain.begin_step(0.5);
  chain.evaluate({0.5001, 1e-4, 1, {}}, y, v, false, response);
  chain.finish_stage({0.5001, 1e-4, 1, {}});
  chain.accept_step(0.5001);
  EXPECT_NEAR(chain.crept().value(), 1e-4 * 2.0 * law.radius, 1e-15);
  law.friction = 0.0;
  EXPECT_FALSE(joints(6, law).crept().has_value());
}

// Joints of a scene that says nothing of damping have none, whatever the law's own default is.
TEST(LinkJoints, OfASceneHaveOnlyTheDampingThatItGives) {
  const keys::Table& joint = *chain_table().find("joint")->table;
  EXPECT_EQ(ChainSpec().joint.damping, 0.0);
  EXPECT_EQ(joint.find("damping_n_s_m")->standard, "0");
}

TEST(LinkJoints, OracleOfAFreeRing) {
  // reference/timing-drive.md: 130 links of 2.4 g at 9.066667 m/s, joint force 24.658932 N.
  // The reference neglects the stretch: joints of 1e11 N/m give by 2.5e-10 m.
  const int n = 130;
  const double k = 1e11, m = 2.4e-3, p = 8e-3, speed = 9.066667, force = 24.658932;
  EXPECT_NEAR(m * speed * speed / p, 24.661333, 3e-6);
  JointLaw law;
  law.stiffness = k;
  LinkJoints chain = joints(n, law);
  // Links that move out by d leave gaps of 2 d sin(pi / n) in the joints.
  const double radius = 0.5 * p / std::tan(std::numbers::pi / n),
               out = 0.5 * force / k / std::sin(std::numbers::pi / n);
  VectorXd y = ring(n, p);
  for (int j = 0; j < n; ++j) y.segment<2>(3 * j) *= 1.0 + out / radius;
  Response response;
  chain.evaluate({0.0, 1e-5, 1, {}}, y, VectorXd::Zero(3 * n), false, response);
  const double w = speed / (n * p / (2.0 * std::numbers::pi));
  for (int j = 0; j < n; j += 13) {
    const Vector2d centre = y.segment<2>(3 * j);
    const Vector2d needed = -m * w * w * centre;
    // Rounding of positions of 0.2 m, 3e-17 m, over the gap.
    EXPECT_LT((response.force.segment<2>(3 * j) - needed).norm(), 1e-5 * needed.norm()) << j;
  }
}

}  // namespace
}  // namespace clatter::dynamics
