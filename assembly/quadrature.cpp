#include "assembly/quadrature.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

namespace clatter::assembly {
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

/// Points whose barycentric coordinates are (rest, value, value, value) and permutations.
void add_corner_orbit(TetRule& rule, Eigen::Index first, double value, double weight) {
  for (int corner = 0; corner < 4; ++corner) {
    Eigen::RowVector3d point = Eigen::RowVector3d::Constant(value);
    if (corner > 0) point(corner - 1) = 1.0 - 3.0 * value;
    rule.points.row(first + corner) = point;
    rule.weights(first + corner) = weight;
  }
}

/// Points whose barycentric coordinates are (value, value, rest, rest) and permutations.
void add_edge_orbit(TetRule& rule, Eigen::Index first, double value, double weight) {
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

TetRule empty_rule(int count) {
  TetRule rule;
  rule.points.resize(count, 3);
  rule.weights.resize(count);
  return rule;
}

TetRule make_rule_4() {
  TetRule rule = empty_rule(4);
  add_corner_orbit(rule, 0, (5.0 - std::sqrt(5.0)) / 20.0, 1.0 / 24.0);
  return rule;
}

TetRule make_rule_14() {
  TetRule rule = empty_rule(14);
  add_corner_orbit(rule, 0, 0.31088591926330060980, 0.11268792571801585080 / 6.0);
  add_corner_orbit(rule, 4, 0.092735250310891226402, 0.073493043116361949544 / 6.0);
  add_edge_orbit(rule, 8, 0.045503704125649649492, 0.042546020777081466438 / 6.0);
  return rule;
}

TetRule make_rule_64() {
  const std::array<LineRule, 3> line = {gauss_jacobi(4, 2), gauss_jacobi(4, 1), gauss_jacobi(4, 0)};
  TetRule rule = empty_rule(64);
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

TriangleRule make_triangle_rule_16() {
  const std::array<LineRule, 2> line = {gauss_jacobi(4, 1), gauss_jacobi(4, 0)};
  TriangleRule rule;
  rule.points.resize(16, 2);
  rule.weights.resize(16);
  Eigen::Index at = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      const double x = line[0].points(i);
      rule.points.row(at) << x, line[1].points(j) * (1.0 - x);
      rule.weights(at++) = line[0].weights(i) * line[1].weights(j);
    }
  }
  return rule;
}

}  // namespace

const TetRule& tet_rule_1() {
  static const TetRule rule = [] {
    TetRule one = empty_rule(1);
    one.points.row(0).setConstant(0.25);
    one.weights(0) = 1.0 / 6.0;
    return one;
  }();
  return rule;
}

const TetRule& tet_rule_4() {
  static const TetRule rule = make_rule_4();
  return rule;
}

const TetRule& tet_rule_14() {
  static const TetRule rule = make_rule_14();
  return rule;
}

const TetRule& tet_rule_64() {
  static const TetRule rule = make_rule_64();
  return rule;
}

const TriangleRule& triangle_rule_16() {
  static const TriangleRule rule = make_triangle_rule_16();
  return rule;
}

}  // namespace clatter::assembly
