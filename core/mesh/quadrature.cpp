// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/quadrature.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

namespace clatter::mesh {
namespace {

struct LineRule {
  Eigen::VectorXd points;   // in (0, 1)
  Eigen::VectorXd weights;  // sum to 1 / (power + 1)
};

/// Gauss rule on (0, 1) for the weight (1 - x)^power by Golub and Welsch (1969): nodes are the
/// eigenvalues of the three-term recurrence of the Jacobi polynomials P^(power, 0).
LineRule gauss_jacobi(int count, int power) {
  Eigen::MatrixXd recurrence = Eigen::MatrixXd::Zero(count, count);
  const double a = power;
  for (int k = 0; k < count; ++k) {
    const double s = 2.0 * k + a;
    recurrence(k, k) = s == 0.0 ? 0.0 : -a * a / (s * (s + 2.0));
    if (k == 0) continue;
    const double product = 4.0 * k * (k + a) * k * (k + a);
    recurrence(k, k - 1) = std::sqrt(product / (s * s * (s + 1.0) * (s - 1.0)));
    recurrence(k - 1, k) = recurrence(k, k - 1);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(recurrence);
  LineRule rule;
  rule.points = 0.5 * (eigen.eigenvalues().array() + 1.0);
  rule.weights = eigen.eigenvectors().row(0).array().square().transpose() / (a + 1.0);
  return rule;
}

/// Gauss rule on (-1, 1).
LineRule gauss_legendre(int count) {
  LineRule rule = gauss_jacobi(count, 0);
  rule.points = 2.0 * rule.points.array() - 1.0;
  rule.weights *= 2.0;
  return rule;
}

/// Points whose barycentric coordinates are (rest, value, value, value) and permutations.
void add_corner_orbit(CellRule& rule, Eigen::Index first, double value, double weight) {
  for (int corner = 0; corner < 4; ++corner) {
    Eigen::RowVector3d point = Eigen::RowVector3d::Constant(value);
    if (corner > 0) point(corner - 1) = 1.0 - 3.0 * value;
    rule.points.row(first + corner) = point;
    rule.weights(first + corner) = weight;
  }
}

/// Points whose barycentric coordinates are (value, value, rest, rest) and permutations.
void add_edge_orbit(CellRule& rule, Eigen::Index first, double value, double weight) {
  const double rest = 0.5 - value;
  Eigen::Index at = first;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      Eigen::RowVector4d barycentric = Eigen::RowVector4d::Constant(rest);
      barycentric(i) = barycentric(j) = value;
      rule.points.row(at) = barycentric.tail<3>();
      rule.weights(at++) = weight;
    }
  }
}

CellRule empty_rule(int count) {
  CellRule rule;
  rule.points.resize(count, 3);
  rule.weights.resize(count);
  return rule;
}

CellRule make_rule_4() {
  CellRule rule = empty_rule(4);
  add_corner_orbit(rule, 0, (5.0 - std::sqrt(5.0)) / 20.0, 1.0 / 24.0);
  return rule;
}

CellRule make_rule_14() {
  CellRule rule = empty_rule(14);
  add_corner_orbit(rule, 0, 0.31088591926330060980, 0.11268792571801585080 / 6.0);
  add_corner_orbit(rule, 4, 0.092735250310891226402, 0.073493043116361949544 / 6.0);
  add_edge_orbit(rule, 8, 0.045503704125649649492, 0.042546020777081466438 / 6.0);
  return rule;
}

CellRule make_hex_rule(int n) {
  const LineRule line = gauss_legendre(n);
  CellRule rule = empty_rule(n * n * n);
  Eigen::Index at = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        rule.points.row(at) << line.points(i), line.points(j), line.points(k);
        rule.weights(at++) = line.weights(i) * line.weights(j) * line.weights(k);
      }
  return rule;
}

CellRule make_pyramid_rule(int n) {
  const LineRule line = gauss_legendre(n), up = gauss_jacobi(n, 2);
  CellRule rule = empty_rule(n * n * n);
  Eigen::Index at = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const double z = up.points(k);
        rule.points.row(at) << line.points(i) * (1.0 - z), line.points(j) * (1.0 - z), z;
        rule.weights(at++) = line.weights(i) * line.weights(j) * up.weights(k);
      }
  return rule;
}

FaceRule make_triangle_rule(int count) {
  FaceRule rule;
  rule.points.resize(count, 2);
  rule.weights.resize(count);
  if (count == 1) {
    rule.points << 1.0 / 3.0, 1.0 / 3.0;
    rule.weights << 0.5;
  } else if (count == 3) {
    const double a = 1.0 / 6.0, b = 2.0 / 3.0;
    rule.points << a, a, b, a, a, b;
    rule.weights.setConstant(1.0 / 6.0);
  } else {
    const double a = 0.44594849091596488632, b = 0.09157621350977074346;
    rule.points << a, a, 1 - 2 * a, a, a, 1 - 2 * a, b, b, 1 - 2 * b, b, b, 1 - 2 * b;
    rule.weights.head<3>().setConstant(0.5 * 0.22338158967801146570);
    rule.weights.tail<3>().setConstant(0.5 * 0.10995174365532186764);
  }
  return rule;
}

CellRule make_wedge_rule(const FaceRule& triangle, int n) {
  const LineRule line = gauss_legendre(n);
  CellRule rule = empty_rule(static_cast<int>(triangle.weights.size()) * n);
  Eigen::Index at = 0;
  for (Eigen::Index t = 0; t < triangle.weights.size(); ++t)
    for (int k = 0; k < n; ++k) {
      rule.points.row(at) << triangle.points.row(t), line.points(k);
      rule.weights(at++) = triangle.weights(t) * line.weights(k);
    }
  return rule;
}

CellRule make_rule_64() {
  const std::array<LineRule, 3> line = {gauss_jacobi(4, 2), gauss_jacobi(4, 1), gauss_jacobi(4, 0)};
  CellRule rule = empty_rule(64);
  Eigen::Index at = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const double x = line[0].points(i);
        const double y = line[1].points(j) * (1.0 - x);
        const double z = line[2].points(k) * (1.0 - x - y);
        rule.points.row(at) << x, y, z;
        rule.weights(at++) = line[0].weights(i) * line[1].weights(j) * line[2].weights(k);
      }
    }
  }
  return rule;
}

/// n^2 points, exact for degree 2 n - 1.
FaceRule make_conical_triangle_rule(int n) {
  const std::array<LineRule, 2> line = {gauss_jacobi(n, 1), gauss_jacobi(n, 0)};
  FaceRule rule;
  rule.points.resize(n * n, 2);
  rule.weights.resize(n * n);
  Eigen::Index at = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = line[0].points(i);
      rule.points.row(at) << x, line[1].points(j) * (1.0 - x);
      rule.weights(at++) = line[0].weights(i) * line[1].weights(j);
    }
  }
  return rule;
}

/// n x n points.
FaceRule make_quad_rule(int n) {
  const LineRule line = gauss_legendre(n);
  FaceRule rule;
  rule.points.resize(n * n, 2);
  rule.weights.resize(n * n);
  for (Eigen::Index q = 0; q < n * n; ++q) {
    rule.points.row(q) << line.points(q / n), line.points(q % n);
    rule.weights(q) = line.weights(q / n) * line.weights(q % n);
  }
  return rule;
}

}  // namespace

const CellRule& tet_rule_1() {
  static const CellRule rule = [] {
    CellRule one = empty_rule(1);
    one.points.row(0).setConstant(0.25);
    one.weights(0) = 1.0 / 6.0;
    return one;
  }();
  return rule;
}

const CellRule& tet_rule_4() {
  static const CellRule rule = make_rule_4();
  return rule;
}

const CellRule& tet_rule_14() {
  static const CellRule rule = make_rule_14();
  return rule;
}

const CellRule& tet_rule_64() {
  static const CellRule rule = make_rule_64();
  return rule;
}

const CellRule& hex_rule(int n) {
  static const std::array<CellRule, 5> rules = {
      make_hex_rule(1), make_hex_rule(2), make_hex_rule(3), make_hex_rule(4), make_hex_rule(5)};
  return rules.at(n - 1);
}

const CellRule& pyramid_rule(int n) {
  static const std::array<CellRule, 5> rules = {make_pyramid_rule(1), make_pyramid_rule(2),
                                                make_pyramid_rule(3), make_pyramid_rule(4),
                                                make_pyramid_rule(5)};
  return rules.at(n - 1);
}

const CellRule& wedge_rule(int triangle, int n) {
  using Along = std::array<CellRule, 5>;
  const auto along = [](const FaceRule& face) {
    return Along{make_wedge_rule(face, 1), make_wedge_rule(face, 2), make_wedge_rule(face, 3),
                 make_wedge_rule(face, 4), make_wedge_rule(face, 5)};
  };
  static const std::array<Along, 4> rules = {
      along(make_triangle_rule(1)), along(make_triangle_rule(3)), along(make_triangle_rule(6)),
      along(make_conical_triangle_rule(5))};
  const size_t row = triangle == 1 ? 0 : triangle == 3 ? 1 : triangle == 6 ? 2 : 3;
  return rules[row].at(n - 1);
}

const CellRule& fine_rule(CellType type) {
  switch (traits(type).corners) {
    case 4:
      return tet_rule_64();
    case 8:
      return hex_rule(5);
    case 6:
      return wedge_rule(25, 5);
    default:
      return pyramid_rule(5);
  }
}

const FaceRule& quad_rule_4() {
  static const FaceRule rule = make_quad_rule(2);
  return rule;
}

const FaceRule& quad_rule_9() {
  static const FaceRule rule = make_quad_rule(3);
  return rule;
}

const FaceRule& quad_rule_16() {
  static const FaceRule rule = make_quad_rule(4);
  return rule;
}

const FaceRule& face_rule(FaceType type) {
  return traits(type).corners == 3 ? triangle_rule_16() : quad_rule_16();
}

const FaceRule& triangle_rule_6() {
  static const FaceRule rule = make_triangle_rule(6);
  return rule;
}

const FaceRule& triangle_rule_16() {
  static const FaceRule rule = make_conical_triangle_rule(4);
  return rule;
}

}  // namespace clatter::mesh
