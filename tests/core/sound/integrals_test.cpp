// SPDX-License-Identifier: GPL-3.0-or-later
// Quadrature rules and pair integrals against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bodies.hpp"
#include "core/sound/kernel.hpp"
#include "core/sound/kernel_array.hpp"
#include "core/sound/pair_integrals.hpp"

namespace clatter::sound {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;
// Wavenumber of the static limit: phases over a metre vanish in rounding.
constexpr double kStatic = 1e-12;

TEST(KernelArray, EqualsTheKernelOfEachDistance) {
  const double k = 36.6;
  for (double first : {1e-4, 0.03, 1.0, 40.0, 2000.0}) {
    Eigen::Array<double, 9, 1> r = first * Eigen::Array<double, 9, 1>::LinSpaced(1.0, 3.0);
    const KernelArray<9> at = kernels<9>(k, r * r);
    for (int i = 0; i < 9; ++i) {
      const Kernel one = kernel(k, r[i]);
      // Phases up to 2e5 lose as many digits of their sine.
      EXPECT_LT(std::abs(Complex(at.g_re[i], at.g_im[i]) - one.g), 1e-10 * std::abs(one.g)) << r[i];
      EXPECT_LT(std::abs(Complex(at.slope_re[i], at.slope_im[i]) - one.slope),
                1e-10 * std::abs(one.slope))
          << r[i];
    }
  }
}

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

/// Mean of N_1^i N_2^j over a triangle.
double mean_of_powers(int i, int j) {
  return 2.0 * factorial(i) * factorial(j) / factorial(i + j + 2);
}

TEST(TriangleRules, AreExactToTheirDegree) {
  for (const auto& [rule, degree] : {std::pair(three_points(), 2), std::pair(six_points(), 4)})
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        double sum = 0.0;
        for (Eigen::Index p = 0; p < rule.weight.size(); ++p)
          sum += rule.weight[p] * std::pow(rule.shape(1, p), i) * std::pow(rule.shape(2, p), j);
        EXPECT_NEAR(sum, mean_of_powers(i, j), 1e-14) << degree << ": " << i << " " << j;
      }
}

TEST(TriangleRules, TouchingRulesCoverBothTrianglesOnce) {
  // Four Gauss points and the Jacobian s^3 leave total degree four.
  for (Contact contact : {Contact::kSame, Contact::kEdge, Contact::kVertex}) {
    const PairRule& rule = touching_rule(contact);
    for (int power = 0; power < 625; ++power) {
      const int i = power / 125, j = power / 25 % 5, k = power / 5 % 5, l = power % 5;
      if (i + j + k + l > 4) continue;
      double sum = 0.0;
      for (Eigen::Index p = 0; p < rule.weight.size(); ++p)
        sum += rule.weight[p] * std::pow(rule.shape_x(1, p), i) * std::pow(rule.shape_x(2, p), j) *
               std::pow(rule.shape_y(1, p), k) * std::pow(rule.shape_y(2, p), l);
      EXPECT_NEAR(sum, mean_of_powers(i, j) * mean_of_powers(k, l), 1e-14)
          << static_cast<int>(contact) << ": " << i << j << k << l;
    }
  }
}

/// Integral of 1/r over a triangle at a point of its plane: per edge, distance times the difference
/// of asinh (height over distance).
double potential(const Facet& y, const Eigen::Vector3d& x) {
  double sum = 0.0;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d from = y.corners.col(a) - x, to = y.corners.col((a + 1) % 3) - x;
    const Eigen::Vector3d along = (to - from).normalized();
    const double distance = from.cross(along).dot(y.normal);
    if (std::abs(distance) < 1e-14) continue;
    sum += distance * (std::asinh(to.dot(along) / std::abs(distance)) -
                       std::asinh(from.dot(along) / std::abs(distance)));
  }
  return sum;
}

/// Solid angle of a triangle, positive on the side of its normal.
double solid_angle(const Facet& y, const Eigen::Vector3d& x) {
  Eigen::Matrix3d to = y.corners.colwise() - x;
  const Eigen::Vector3d r = to.colwise().norm();
  return -2.0 * std::atan2(to.determinant(), r.prod() + to.col(0).dot(to.col(1)) * r[2] +
                                                 to.col(1).dot(to.col(2)) * r[0] +
                                                 to.col(2).dot(to.col(0)) * r[1]);
}

/// Integral over x of N_a times a function, by 4^depth parts with six points each.
template <class Function>
Eigen::Vector3d outer_integral(const Facet& x, int depth, const Function& function) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  if (depth > 0) {
    for (int part = 0; part < 4; ++part)
      sum += outer_integral(x.quarter(part), depth - 1, function);
    return sum;
  }
  const TriangleRule& rule = six_points();
  for (Eigen::Index p = 0; p < rule.weight.size(); ++p)
    sum += rule.weight[p] * x.area * function(x.corners * rule.shape.col(p)) *
           (x.shape * rule.shape.col(p));
  return sum;
}

/// Triangles 0-1-2 and others about it: with the same corners, with a common edge and a common
/// corner, near and far; flat in the plane z = 0 or folded by `angle` about the edge 0-1.
std::vector<PreparedFacet> neighbours(double angle) {
  RowMatrix nodes(9, 3);
  nodes << 0, 0, 0, 1, 0.1, 0, 0.3, 0.8, 0, 0.6, -0.7, 0, -0.4, -0.6, 0, 1.0, -0.2, 0, 2.0, -0.1, 0,
      1.4, -0.9, 0, 2.6, -0.7, 0;
  const Eigen::AngleAxisd fold(angle, nodes.row(1).transpose().normalized());
  for (Eigen::Index n = 3; n < nodes.rows(); ++n)
    nodes.row(n) = (fold * nodes.row(n).transpose()).transpose();
  Surface surface;
  surface.nodes = nodes;
  surface.triangles.resize(6, 3);
  surface.triangles << 0, 1, 2, 1, 0, 3, 0, 4, 3, 1, 3, 5, 5, 3, 7, 6, 7, 8;
  return prepared_facets(surface);
}

TEST(PairIntegrals, StaticSingleLayerIsThePotentialOfAFlatTriangle) {
  const auto facets = neighbours(0.0);
  for (size_t y = 0; y < facets.size(); ++y) {
    const PairIntegrals pair = pair_integrals(kStatic, facets[0], facets[y], true);
    const Eigen::Vector3d expected =
        outer_integral(facets[0].facet, 6,
                       [&](const Eigen::Vector3d& x) { return potential(facets[y].facet, x); }) /
        (4.0 * kPi);
    EXPECT_LT((pair.single_layer.real().rowwise().sum() - expected).norm(), 3e-4 * expected.norm())
        << y;
    EXPECT_LT(pair.double_layer.norm(), 1e-15) << "the plane sees no dipoles of its own";
  }
}

TEST(PairIntegrals, StaticDoubleLayerIsTheSolidAngle) {
  const auto facets = neighbours(1.2);
  for (size_t y = 1; y < facets.size(); ++y) {
    const PairIntegrals pair = pair_integrals(kStatic, facets[0], facets[y], true);
    const Eigen::Vector3d expected =
        outer_integral(facets[0].facet, 6,
                       [&](const Eigen::Vector3d& x) { return solid_angle(facets[y].facet, x); }) /
        (4.0 * kPi);
    EXPECT_LT((pair.double_layer.real().rowwise().sum() - expected).norm(), 3e-3 * expected.norm())
        << y;
  }
}

TEST(PairIntegrals, ExchangeOfTheFacetsTransposes) {
  const auto facets = neighbours(0.7);
  for (size_t y = 1; y < facets.size(); ++y) {
    const PairIntegrals there = pair_integrals(3.0, facets[0], facets[y], true);
    const PairIntegrals back = pair_integrals(3.0, facets[y], facets[0], true);
    // Four Gauss points leave 4e-4 on these triangles; the rule of a common edge has two sides.
    EXPECT_LT((there.single_layer - back.single_layer.transpose()).norm(),
              1e-3 * there.single_layer.norm());
    EXPECT_LT((there.adjoint - back.double_layer.transpose()).norm(), 1e-3 * there.adjoint.norm());
  }
}

TEST(PairIntegrals, NearFacetsAreDividedUntilTheirGapIsResolved) {
  // Two parallel triangles with a gap of a fifth of their size.
  Surface surface;
  surface.nodes.resize(6, 3);
  surface.nodes << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.2, 0, 1, 0.2, 1, 0, 0.2;
  surface.triangles.resize(2, 3);
  surface.triangles << 0, 1, 2, 3, 4, 5;
  const auto facets = prepared_facets(surface);
  const PairIntegrals pair = pair_integrals(kStatic, facets[0], facets[1], true);
  const Eigen::Vector3d expected =
      outer_integral(facets[0].facet, 6,
                     [&](const Eigen::Vector3d& x) { return solid_angle(facets[1].facet, x); }) /
      (4.0 * kPi);
  EXPECT_LT((pair.double_layer.real().rowwise().sum() - expected).norm(), 1e-3 * expected.norm());
}

}  // namespace
}  // namespace clatter::sound
