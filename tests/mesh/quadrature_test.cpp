// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace clatter::mesh {
namespace {

double factorial(int n) { return std::tgamma(n + 1.0); }

double worst_tet_error(const CellRule& rule, int degree) {
  double worst = 0.0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) {
        double sum = 0.0;
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
          sum += rule.weights(q) * std::pow(rule.points(q, 0), i) * std::pow(rule.points(q, 1), j) *
                 std::pow(rule.points(q, 2), k);
        // int x^i y^j z^k = i! j! k! / (i + j + k + 3)!
        const double exact = factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
        worst = std::max(worst, std::abs(sum - exact) / exact);
      }
  return worst;
}

TEST(Quadrature, TetRulesIntegrateEveryMonomialOfTheirDegree) {
  // 1e-14: tabulated to 20 digits; 1e-12: points from a 4 x 4 eigenproblem, up to 7th powers.
  EXPECT_LT(worst_tet_error(tet_rule_1(), 1), 1e-14);
  EXPECT_LT(worst_tet_error(tet_rule_4(), 2), 1e-14);
  EXPECT_LT(worst_tet_error(tet_rule_14(), 5), 1e-13);
  EXPECT_LT(worst_tet_error(tet_rule_64(), 7), 1e-12);
}

TEST(Quadrature, TetRulesAreNotExactBeyondTheirDegree) {
  EXPECT_GT(worst_tet_error(tet_rule_1(), 2), 1e-3);
  EXPECT_GT(worst_tet_error(tet_rule_4(), 3), 1e-3);
  EXPECT_GT(worst_tet_error(tet_rule_14(), 6), 1e-4);
}

TEST(Quadrature, AllWeightsArePositiveAndAllPointsInside) {
  for (const CellRule* rule : {&tet_rule_1(), &tet_rule_4(), &tet_rule_14(), &tet_rule_64()}) {
    EXPECT_GT(rule->weights.minCoeff(), 0.0);
    EXPECT_GT(rule->points.minCoeff(), 0.0);
    EXPECT_LT(rule->points.rowwise().sum().maxCoeff(), 1.0);
  }
}

void expect_triangle_exact(const FaceRule& rule, int degree) {
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) {
      double sum = 0.0;
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
        sum += rule.weights(q) * std::pow(rule.points(q, 0), i) * std::pow(rule.points(q, 1), j);
      const double exact = factorial(i) * factorial(j) / factorial(i + j + 2);
      EXPECT_NEAR(sum / exact, 1.0, 1e-12) << i << " " << j;
    }
}

TEST(Quadrature, TriangleRulesIntegrateDegreesFourAndSeven) {
  expect_triangle_exact(triangle_rule_6(), 4);
  expect_triangle_exact(triangle_rule_16(), 7);
}

TEST(Quadrature, QuadRuleOfFourPointsIntegratesCubics) {
  const FaceRule& rule = quad_rule_4();
  ASSERT_EQ(rule.weights.size(), 4);
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; j <= 3; ++j) {
      double sum = 0.0;
      for (Eigen::Index q = 0; q < 4; ++q)
        sum += rule.weights(q) * std::pow(rule.points(q, 0), i) * std::pow(rule.points(q, 1), j);
      const double exact = (i % 2 ? 0.0 : 2.0 / (i + 1)) * (j % 2 ? 0.0 : 2.0 / (j + 1));
      EXPECT_NEAR(sum, exact, 1e-14) << i << " " << j;
    }
}

}  // namespace
}  // namespace clatter::mesh
