// SPDX-License-Identifier: GPL-3.0-or-later
// Order of convergence with a manufactured solution on the unit cube.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "assembly/load/mass_integral.hpp"
#include "block_mesh.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/element.hpp"
#include "core/fe/stress.hpp"
#include "core/mesh/shape.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

const fe::Material kMaterial{1.0, 0.3, 1.0};

/// u = s (1, 1, 1), s = sin(pi x) sin(pi y) sin(pi z).
double wave(const Eigen::Vector3d& x) {
  return std::sin(std::numbers::pi * x(0)) * std::sin(std::numbers::pi * x(1)) *
         std::sin(std::numbers::pi * x(2));
}

/// b = -(lambda + mu) grad div u - mu laplacian u.
Eigen::Vector3d body_force(const Eigen::Vector3d& x) {
  Eigen::Vector3d s, c, b;
  for (int d = 0; d < 3; ++d)
    s(d) = std::sin(std::numbers::pi * x(d)), c(d) = std::cos(std::numbers::pi * x(d));
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    // d/dx_i sum_j ds/dx_j
    const double grad_div = std::numbers::pi * std::numbers::pi *
                            (-s(0) * s(1) * s(2) + c(i) * c(j) * s(k) + c(i) * s(j) * c(k));
    b(i) = -(kMaterial.lambda() + kMaterial.mu()) * grad_div +
           kMaterial.mu() * 3.0 * std::numbers::pi * std::numbers::pi * s.prod();
  }
  return b;
}

/// C eps of u.
fe::Voigt exact_stress(const Eigen::Vector3d& x) {
  Eigen::Vector3d s, c, slope;
  for (int d = 0; d < 3; ++d)
    s(d) = std::sin(std::numbers::pi * x(d)), c(d) = std::cos(std::numbers::pi * x(d));
  for (int d = 0; d < 3; ++d) slope(d) = std::numbers::pi * c(d) * s((d + 1) % 3) * s((d + 2) % 3);
  fe::Voigt strain;
  strain << slope(0), slope(1), slope(2), slope(0) + slope(1), slope(1) + slope(2),
      slope(2) + slope(0);
  return kMaterial.elasticity_at(x) * strain;
}

struct Errors {
  double u = 0.0;       // L2 norm
  double stress = 0.0;  // root of the mean square over nodes and components
};

double stress_error(const mesh::Mesh& mesh, const Eigen::VectorXd& u) {
  const fe::FeCells cells{mesh.regions, materials_of(mesh, kMaterial), mesh.cells, {}, {}, {}};
  const fe::RegionStress found = fe::nodal_stress(mesh.nodes, cells, u, {})[0];
  double square = 0.0;
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    square += (found.stress.row(a).transpose() - exact_stress(mesh.nodes.row(a).transpose()))
                  .squaredNorm();
  return std::sqrt(square / static_cast<double>(6 * mesh.nodes.rows()));
}

Errors errors_at(int cells, mesh::CellType type) {
  BlockOptions options;
  options.type = type;
  const mesh::Mesh mesh = block_mesh({cells, cells, cells}, brick({1, 1, 1}), options);
  const IndexMatrix& nodes = mesh.cells[0].nodes;
  const fe::NodalMatrices matrices =
      fe::assemble(mesh, materials_of(mesh, kMaterial), fe::node_pattern(mesh));
  const Eigen::Index n = 3 * mesh.nodes.rows();
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
  for_each_mass_point(mesh, mesh.cells[0], 1.0,
                      [&](Eigen::Index c, const auto& value, const Eigen::Vector3d& x, double dV) {
                        for (Eigen::Index a = 0; a < value.size(); ++a)
                          f.segment<3>(3 * nodes(c, a)) += dV * value(a) * body_force(x);
                      });
  std::vector<bool> fixed(static_cast<size_t>(n), false);
  for (const int32_t node : mesh::nodes_of(mesh.surface("skin")))
    for (int d = 0; d < 3; ++d) fixed[3 * node + d] = true;
  const Eigen::VectorXd u = solve_fixed(matrices.K, f, fixed, Eigen::VectorXd::Zero(n));
  double square = 0.0;
  for_each_mass_point(mesh, mesh.cells[0], 1.0,
                      [&](Eigen::Index c, const auto& value, const Eigen::Vector3d& x, double dV) {
                        Eigen::Vector3d at = Eigen::Vector3d::Constant(-wave(x));
                        for (Eigen::Index a = 0; a < value.size(); ++a)
                          at += value(a) * u.segment<3>(3 * nodes(c, a));
                        square += dV * at.squaredNorm();
                      });
  return {std::sqrt(square), stress_error(mesh, u)};
}

double rate_of(mesh::CellType type, int cells) {
  return std::log2(errors_at(cells, type).u / errors_at(2 * cells, type).u);
}

double stress_rate_of(mesh::CellType type, int cells) {
  return std::log2(errors_at(cells, type).stress / errors_at(2 * cells, type).stress);
}

using mesh::CellType;

TEST(AssemblyOrder, LinearTetrahedraConvergeWithSecondOrder) {
  // Theory 2; half a wave over 6 and 12 cells is not yet the limit.
  EXPECT_GT(rate_of(CellType::kTet4, 6), 1.8);
  EXPECT_LT(rate_of(CellType::kTet4, 6), 2.3);
}

TEST(AssemblyOrder, LinearBricksWedgesAndPyramidsConvergeWithSecondOrder) {
  for (const CellType type : {CellType::kHex8, CellType::kWedge6, CellType::kPyramid5}) {
    EXPECT_GT(rate_of(type, 4), 1.8) << mesh::traits(type).name;
    EXPECT_LT(rate_of(type, 4), 2.3) << mesh::traits(type).name;
  }
}

TEST(AssemblyOrder, QuadraticCellsConvergeWithThirdOrder) {
  for (const CellType type :
       {CellType::kTet10, CellType::kHex20, CellType::kWedge15, CellType::kPyramid13}) {
    EXPECT_GT(rate_of(type, 2), 2.7) << mesh::traits(type).name;
    EXPECT_LT(rate_of(type, 2), 3.6) << mesh::traits(type).name;
  }
}

// Theory for derivatives: order 1 in linear, 2 in quadratic cells. Means over neighbours add to it
// inside the body, where errors of opposite sign cancel; at its faces they do not.

TEST(StressOrder, NodalStressOfLinearCellsConvergesBeyondFirstOrder) {
  for (const CellType type :
       {CellType::kTet4, CellType::kHex8, CellType::kWedge6, CellType::kPyramid5}) {
    const double rate = stress_rate_of(type, 4);  // measured 1.19 to 1.59
    EXPECT_GT(rate, 1.1) << mesh::traits(type).name;
    EXPECT_LT(rate, 2.1) << mesh::traits(type).name;
  }
}

TEST(StressOrder, NodalStressOfQuadraticCellsConvergesWithSecondOrder) {
  for (const CellType type :
       {CellType::kTet10, CellType::kHex20, CellType::kWedge15, CellType::kPyramid13}) {
    const double rate = stress_rate_of(type, 3);  // measured 1.80 to 1.94, rising with finer cells
    EXPECT_GT(rate, 1.75) << mesh::traits(type).name;
    EXPECT_LT(rate, 2.5) << mesh::traits(type).name;
  }
}

}  // namespace
}  // namespace clatter::assembly::testing
