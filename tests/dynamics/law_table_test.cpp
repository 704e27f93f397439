// SPDX-License-Identifier: GPL-3.0-or-later
// Laws as tables: the monotone cubic with its slope and integral, joints by a table.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"
#include "tests/dynamics/element_check.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

TEST(RisingTable, OfAStraightLineIsThatLineAndGoesOn) {
  const RisingTable table({0.0, 1.0, 3.0}, {0.0, 2.0, 6.0});
  for (const double x : {0.0, 0.3, 1.0, 2.5, 3.0, 4.0}) {
    EXPECT_NEAR(table.value(x), 2.0 * x, 1e-15 * (1.0 + x));
    EXPECT_NEAR(table.slope(x), 2.0, 1e-14);
    EXPECT_NEAR(table.integral(x), x * x, 1e-14 * (1.0 + x * x));
  }
}

TEST(RisingTable, IsSmoothAndItsIntegralIsThatOfItsValue) {
  const RisingTable table({0.0, 0.5, 1.0, 2.0, 2.5}, {0.0, 0.1, 1.0, 1.0, 3.0});
  const double h = 1e-6;
  for (double x = 0.01; x < 3.0; x += 0.0173) {
    // Rounding over 2 h: 1e-10; the slope's kink at a point: h times the second derivative.
    EXPECT_NEAR((table.value(x + h) - table.value(x - h)) / (2 * h), table.slope(x), 2e-5);
    EXPECT_NEAR((table.integral(x + h) - table.integral(x - h)) / (2 * h), table.value(x), 1e-8);
    EXPECT_GE(table.slope(x), 0.0);
  }
  EXPECT_DOUBLE_EQ(table.value(1.5), 1.0);  // no new extremum between equal values
}

TEST(RisingTable, RefusesWhatDoesNotRiseFromZero) {
  const auto refused = [](std::vector<double> x, std::vector<double> y) {
    return test::refusal_of([&] { RisingTable(x, y); });
  };
  test::expect_parts(refused({0.0}, {0.0}), {"found 1 rows, expected at least 2"});
  test::expect_parts(refused({0.0, 1.0}, {1.0, 2.0}), {"found 1 at 0 first, expected 0 at 0"});
  test::expect_parts(refused({0.0, 2.0, 1.0}, {0.0, 1.0, 2.0}), {"found 1 after 2"});
  test::expect_parts(refused({0.0, 1.0, 2.0}, {0.0, 2.0, 1.0}),
                     {"found 1 after 2, expected values that do not descend"});
}

TEST(Spline, SlopeIsThatOfItsValue) {
  const std::vector<double> x{0.0, 1.0, 1.5, 4.0}, y{0.0, 2.0, 1.0, 3.0};
  for (const double period : {0.0, 5.0}) {
    for (const Spline::Kind kind : {Spline::Kind::kLinear, Spline::Kind::kMonotoneCubic}) {
      const Spline spline(kind, x, y, period);
      const double h = 1e-7;
      for (double at = -1.95; at < 7.0; at += 0.0371)
        EXPECT_NEAR((spline(at + h) - spline(at - h)) / (2 * h), spline.slope(at), 2e-6)
            << period << " " << at;
    }
  }
}

/// The law F = k_s e + k <e - c>^1.5 of a joint as a table of `points`.
RadialTable tabled(const RadialLaw& law, int points, double last) {
  std::vector<double> x, y;
  for (int k = 0; k < points; ++k) {
    x.push_back(last * k / (points - 1));
    y.push_back(law.force(x.back()));
  }
  return {RisingTable(x, y), Spline(Spline::Kind::kLinear, {0.0}, {law.damping})};
}

TEST(RadialTable, ApproachesTheLawThatItWasMadeFrom) {
  const RadialLaw law{1e-5, 1e7, 1e11, 1.5, 2e4};
  double last = 0.0;
  for (const int points : {41, 81, 161}) {
    const RadialTable table = tabled(law, points, 4e-5);
    double worst = 0.0;
    for (double e = 0.0; e < 4e-5; e += 1.3e-7)
      worst = std::max(worst, std::abs(table.force(e) - law.force(e)) / law.force(4e-5));
    // Second order where the law has no second derivative, at e = c; better elsewhere.
    if (last > 0.0) {
      EXPECT_LT(worst, last / 2.5) << points;
    }
    last = worst;
  }
  EXPECT_LT(last, 2e-5);
}

/// A joint on two coordinates whose damping varies.
PairElement table_joint() {
  const RisingTable force({0.0, 1e-5, 2e-5, 4e-5}, {0.0, 50.0, 400.0, 9000.0});
  const Spline damping(Spline::Kind::kMonotoneCubic, {0.0, 2e-5, 4e-5}, {1e3, 5e3, 2e4});
  PointWeights point;
  point.add(0, 1.0, 0.0);
  point.add(1, 0.0, 1.0);
  return PairElement("pin", std::make_unique<WeightedPort>(point),
                     std::make_unique<WeightedPort>(PointWeights{}),
                     std::make_unique<RadialJoint>(RadialTable(force, damping)));
}

TEST(RadialTable, TangentAndPowerOfItsJointAreExact) {
  PairElement joint = table_joint();
  const Eigen::Vector2d y(1.7e-5, -1.2e-5), before(2e-6, 3e-6), v(0.3, 0.1);
  EXPECT_LT(testing::tangent_error(joint, {0.0, 3e-6, 1, {}}, y, before, 1e-11), 1e-7);
  EXPECT_LT(testing::power_error(joint, 0.0, y, v, 1e-8), 1e-7);
}

TEST(RadialJoint, OfATableHasItsForceAlongTheDistanceAndItsDerivatives) {
  const RisingTable rising({0.0, 1e-3, 3e-3}, {0.0, 10.0, 90.0});
  const Spline damping(Spline::Kind::kMonotoneCubic, {0.0, 2e-3}, {5.0, 50.0});
  RadialJoint joint(RadialTable(rising, damping));
  const auto force = [&](const PairMotion& motion) { return joint.force({}, motion, true); };
  const PairMotion rest{{0.0, 1e-3, 0.0}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  EXPECT_LT((force(rest).force - Eigen::Vector3d(0, -10, 0)).norm(), 1e-12);
  const PairMotion at{{4e-4, -9e-4, 3e-4}, {0.1, 0.2, -0.3}, Eigen::Vector3d::Zero()};
  const PairForce law = force(at);
  for (int j = 0; j < 3; ++j) {
    PairMotion a = at, b = at;
    const double h = 1e-9;
    a.distance(j) += h;
    b.distance(j) -= h;
    const Eigen::Vector3d column = (force(a).force - force(b).force) / (2.0 * h);
    EXPECT_LT((column - law.by_distance.col(j).head<3>()).norm(), 1e-5 * law.by_distance.norm());
    a = b = at;
    a.velocity(j) += 1e-4;
    b.velocity(j) -= 1e-4;
    const Eigen::Vector3d by_rate = (force(a).force - force(b).force) / 2e-4;
    EXPECT_LT((by_rate - law.by_rate.col(j).head<3>()).norm(), 1e-9 * law.by_rate.norm());
  }
  EXPECT_EQ(force({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()})
                .force.norm(),
            0.0);
}

}  // namespace
}  // namespace clatter::dynamics
