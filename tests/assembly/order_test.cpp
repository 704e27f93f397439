// Order of convergence with a manufactured solution on the unit cube.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "assembly/assemble.hpp"
#include "assembly/element.hpp"
#include "block_mesh.hpp"
#include "mesh/quadrature.hpp"
#include "mesh/shape.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr double kPi = std::numbers::pi;
const Material kMaterial{1.0, 0.3, 1.0};

/// u = s (1, 1, 1), s = sin(pi x) sin(pi y) sin(pi z).
double wave(const Eigen::Vector3d& x) {
  return std::sin(kPi * x(0)) * std::sin(kPi * x(1)) * std::sin(kPi * x(2));
}

/// b = -(lambda + mu) grad div u - mu laplacian u.
Eigen::Vector3d body_force(const Eigen::Vector3d& x) {
  Eigen::Vector3d s, c, b;
  for (int d = 0; d < 3; ++d) s(d) = std::sin(kPi * x(d)), c(d) = std::cos(kPi * x(d));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    // d/dx_i sum_j ds/dx_j
    const double grad_div =
        kPi * kPi * (-s(0) * s(1) * s(2) + c(i) * c(j) * s(k) + c(i) * s(j) * c(k));
    b(i) = -(kMaterial.lambda() + kMaterial.mu()) * grad_div +
           kMaterial.mu() * 3.0 * kPi * kPi * s.prod();
  }
  return b;
}

template <int N, typename Visit>
void at_points(const mesh::Mesh& mesh, const Visit& visit) {
  const mesh::CellRule& rule = mesh::tet_rule_64();
  const mesh::CellType type = mesh.cells[0].type;
  for (Eigen::Index c = 0; c < mesh.cells[0].nodes.rows(); ++c) {
    CellNodes<N> x;
    for (int a = 0; a < N; ++a) x.row(a) = mesh.nodes.row(mesh.cells[0].nodes(c, a));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const auto shape = mesh::cell_shape(type, rule.points.row(q).transpose());
      const double dV =
          rule.weights(q) * Eigen::Matrix3d(x.transpose() * shape.gradient).determinant();
      visit(c, shape.value, Eigen::Vector3d(x.transpose() * shape.value), dV);
    }
  }
}

/// L2 norm of the error of u.
template <int N>
double error_at(int cells, mesh::CellType type) {
  BlockOptions options;
  options.type = type;
  const mesh::Mesh mesh = block_mesh({cells, cells, cells}, brick({1, 1, 1}), options);
  const IndexMatrix& nodes = mesh.cells[0].nodes;
  const NodalMatrices matrices = assemble(mesh, materials_of(mesh, kMaterial), node_pattern(mesh));
  const Eigen::Index n = 3 * mesh.nodes.rows();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
  at_points<N>(mesh, [&](Eigen::Index c, const auto& value, const Eigen::Vector3d& x, double dV) {
    for (int a = 0; a < N; ++a) f.segment<3>(3 * nodes(c, a)) += dV * value(a) * body_force(x);
  });
  std::vector<bool> fixed(static_cast<size_t>(n), false);
  for (const int32_t node : mesh::nodes_of(mesh.surface("skin")))
    for (int d = 0; d < 3; ++d) fixed[static_cast<size_t>(3 * node + d)] = true;
  const Eigen::VectorXd u = solve_fixed(matrices.K, f, fixed, Eigen::VectorXd::Zero(n));
  double square = 0.0;
  at_points<N>(mesh, [&](Eigen::Index c, const auto& value, const Eigen::Vector3d& x, double dV) {
    Eigen::Vector3d at = Eigen::Vector3d::Constant(-wave(x));
    for (int a = 0; a < N; ++a) at += value(a) * u.segment<3>(3 * nodes(c, a));
    square += dV * at.squaredNorm();
  });
  return std::sqrt(square);
}

TEST(AssemblyOrder, LinearTetrahedraConvergeWithSecondOrder) {
  const double rate =
      std::log2(error_at<4>(6, mesh::CellType::kTet4) / error_at<4>(12, mesh::CellType::kTet4));
  // Theory 2; half a wave over 6 and 12 cells is not yet the limit.
  EXPECT_GT(rate, 1.8);
  EXPECT_LT(rate, 2.3);
}

TEST(AssemblyOrder, QuadraticTetrahedraConvergeWithThirdOrder) {
  const double rate =
      std::log2(error_at<10>(3, mesh::CellType::kTet10) / error_at<10>(6, mesh::CellType::kTet10));
  EXPECT_GT(rate, 2.8);
  EXPECT_LT(rate, 3.5);
}

}  // namespace
}  // namespace clatter::assembly::testing
