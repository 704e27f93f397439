// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/pin_guide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/random_matrix.hpp"

namespace clatter::dynamics {
namespace {

const SliderCrank kOffsetCrank(0.065, 0.21, 0.001, CrankClock{2000.0 * std::numbers::pi / 30.0});

PinGuide guide_on_block() {
  return PinGuide("pin_guide", {}, path_of_pin(kOffsetCrank), {0, 1, 2}, std::array{3, 4, 5});
}

Eigen::VectorXd six_numbers(double scale, unsigned seed) {
  return scale * test::random_vector(6, seed);
}

TEST(PinGuide, PushesPinAndBlockApartWithEqualForcesAtThePinsHeight) {
  PinGuide guide = guide_on_block();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6);
  y(0) = 2e-6;
  Response response;
  guide.evaluate({0.004, 1e-6, 1, {}}, y, Eigen::VectorXd::Zero(6), false, response);
  const Eigen::VectorXd& f = response.force;
  EXPECT_NEAR(f(0), -2.0, 1e-12);  // 1e6 N/m
  EXPECT_NEAR(f(3), 2.0, 1e-12);
  EXPECT_NEAR(f(4), 2.0 * kOffsetCrank.piston_pin(0.004).position, 1e-12);  // moment z F_x
  EXPECT_NEAR(f(5), -2.0 * 0.001, 1e-12);                                   // -y F_x
}

TEST(PinGuide, TangentMatchesDifferences) {
  PinGuide guide = guide_on_block();
  const Stage stage{0.0031, 2e-6, 1, {2e-6}};
  const Eigen::VectorXd y = six_numbers(2e-5, 3), y_tilde = six_numbers(2e-5, 4);
  Response at, plus, minus;
  guide.evaluate(stage, y, (y - y_tilde) / stage.kappa, true, at);
  for (int j = 0; j < 6; ++j) {
    const double h = 1e-6;
    Eigen::VectorXd a = y, b = y;
    a(j) += h;
    b(j) -= h;
    guide.evaluate(stage, a, (a - y_tilde) / stage.kappa, false, plus);
    guide.evaluate(stage, b, (b - y_tilde) / stage.kappa, false, minus);
    const Eigen::VectorXd column = (plus.force - minus.force) / (2.0 * h);
    EXPECT_LT((column - at.tangent.col(j)).norm(), 1e-11 * at.tangent.norm()) << j;
  }
}

TEST(PinGuide, PowerBalancesExactly) {
  // force . v + d(stored)/dt + lost = input; the pin slides along a tilted block.
  PinGuide guide = guide_on_block();
  const double t = 0.0013, h = 1e-7;
  const Eigen::VectorXd y = six_numbers(3e-5, 5), v = six_numbers(0.3, 6);
  Response response;
  const auto at = [&](double time) {
    const Stage stage{time, 1e-6, 1, {}};
    guide.evaluate(stage, y + (time - t) * v, v, false, response);
    return guide.power(y + (time - t) * v, v);
  };
  const double rate = (at(t + h).stored - at(t - h).stored) / (2.0 * h);
  const Power power = at(t);
  const double work = response.force.dot(v);
  EXPECT_GT(std::abs(power.input), 1e-4);
  EXPECT_NEAR(work + rate + power.lost, power.input, 1e-7 * (std::abs(work) + std::abs(rate)));
}

TEST(PinGuide, WithoutABlockHoldsThePinToTheGround) {
  PinGuide guide("pin_guide", {1e6, 1e2, 1e4, 1.0}, path_of_pin(kOffsetCrank), {0, 1, 2},
                 std::nullopt);
  ASSERT_EQ(guide.coordinates().size(), 3U);
  Response response;
  guide.evaluate({0.001, 1e-6, 1, {}}, Eigen::Vector3d(1e-6, 1e-5, 0.0),
                 Eigen::Vector3d(0.0, 0.0, 0.1), true, response);
  EXPECT_LT((response.force - Eigen::Vector3d(-1.0, -0.1, -0.1)).norm(), 1e-14);
  EXPECT_EQ(response.tangent(0, 0), -1e6 - 1e2 / 1e-6);
}

}  // namespace
}  // namespace clatter::dynamics
