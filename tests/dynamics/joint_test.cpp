// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "tests/random_matrix.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace clatter::dynamics {
namespace {

const SliderCrank kCrank(0.065, 0.21, 0.001, CrankClock{2000.0 * std::numbers::pi / 30.0});

PairElement pin_joint(double exponent) {
  RadialLaw law{1e-5, 1e7, exponent > 1.0 ? 1e11 : 1e9, exponent, 2e4};
  PointWeights nodes;
  for (const int k : {0, 2}) {
    nodes.add(k, 0.5, 0.0);
    nodes.add(k + 1, 0.0, 0.5);
  }
  return PairElement(
      "pin", std::make_unique<WeightedPort>(nodes),
      std::make_unique<RodPort>(std::vector<int>{4, 5, 6}, kCrank, Eigen::Vector2d(0.0, 0.14)),
      std::make_unique<RadialJoint>(law));
}

Eigen::VectorXd some(double scale, unsigned seed) { return scale * test::random_vector(7, seed); }

TEST(RadialLaw, IsSmoothAndItsEnergyIsItsIntegral) {
  for (const double exponent : {1.0, 1.5, 2.0}) {
    const RadialLaw law{1e-5, 1e7, exponent > 1.0 ? 1e11 : 1e9, exponent, 0.0};
    const double h = 1e-10;
    for (double e = 1e-7; e < 4e-5; e += 3.1e-7) {
      const double force = (law.energy(e + h) - law.energy(e - h)) / (2.0 * h);
      const double slope = (law.force(e + h) - law.force(e - h)) / (2.0 * h);
      // Rounding of the energy over 2 h: eps 1 J / 1e-10 m; h^2 terms are smaller.
      EXPECT_NEAR(force, law.force(e), 1e-5 * law.force(e) + 1e-4);
      EXPECT_NEAR(slope, law.slope(e), 1e-5 * law.slope(e));
    }
  }
}

TEST(Joint, TangentMatchesDifferences) {
  for (const double exponent : {1.0, 1.5}) {
    PairElement joint = pin_joint(exponent);
    const Stage stage{0.0031, 2e-6, 1, {2e-6}};
    const Eigen::VectorXd y = some(2e-5, 3), y_tilde = some(2e-5, 4);
    Response at, plus, minus;
    joint.evaluate(stage, y, (y - y_tilde) / stage.kappa, true, at);
    for (int j = 0; j < 7; ++j) {
      const double h = 1e-9;
      Eigen::VectorXd a = y, b = y;
      a(j) += h;
      b(j) -= h;
      joint.evaluate(stage, a, (a - y_tilde) / stage.kappa, false, plus);
      joint.evaluate(stage, b, (b - y_tilde) / stage.kappa, false, minus);
      const Eigen::VectorXd column = (plus.force - minus.force) / (2.0 * h);
      EXPECT_LT((column - at.tangent.col(j)).norm(), 1e-11 * at.tangent.norm()) << j;
    }
  }
}

TEST(Joint, PowerBalancesExactly) {
  // force . v + d(stored)/dt + lost = input, with the stored energy differenced along the motion.
  PairElement joint = pin_joint(1.5);
  const double t = 0.0013, h = 1e-9;
  const Eigen::VectorXd y = some(3e-5, 5), v = some(0.3, 6);
  Response response;
  const auto at = [&](double time) {
    joint.evaluate({time, 1e-6, 1, {}}, y + (time - t) * v, v, false, response);
    joint.finish_stage({time, 1e-6, 1, {}});
    return joint.power(y, v);
  };
  const double rate = (at(t + h).stored - at(t - h).stored) / (2.0 * h);
  const Power power = at(t);
  const double work = response.force.dot(v);
  const double size = std::abs(work) + std::abs(power.lost) + std::abs(rate);
  EXPECT_LT(std::abs(work + rate + power.lost - power.input), 3e-11 * size);
  EXPECT_GT(power.lost, 0.0);
}

TEST(Joint, ForcesOfBothSidesCancel) {
  PairElement joint = pin_joint(1.0);
  Response response;
  joint.evaluate({0.0, 1e-6, 1, {}}, some(3e-5, 1), some(0.1, 2), false, response);
  const Eigen::VectorXd& f = response.force;
  EXPECT_NEAR(f(0) + f(2) + f(4), 0.0, 1e-9 * f.norm());
  EXPECT_NEAR(f(1) + f(3) + f(5), 0.0, 1e-9 * f.norm());
  EXPECT_NEAR(f(0), f(2), 1e-12 * f.norm());  // half on each node
}

}  // namespace
}  // namespace clatter::dynamics
