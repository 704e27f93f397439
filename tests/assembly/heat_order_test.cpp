// SPDX-License-Identifier: GPL-3.0-or-later
// Order of convergence of temperatures.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "assembly/load/mass_integral.hpp"
#include "block_mesh.hpp"
#include "core/fe/heat.hpp"
#include "one_cell.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellType;
constexpr double kPi = std::numbers::pi;

double hill(const Eigen::Vector3d& x) {
  return std::sin(kPi * x(0)) * std::sin(kPi * x(1)) * std::sin(kPi * x(2));
}

/// Root of the integral of (T - T_h)^2 over the unit cube: T = hill, zero on the skin, k = 2.
double cube_error(CellType type, int cells) {
  BlockOptions options;
  options.type = type;
  const mesh::Mesh mesh = block_mesh({cells, cells, cells}, brick({1, 1, 1}), options);
  fe::Material material = kSteel;
  material.conductivity.setConstant(2.0);
  const SparseMatrix K = fe::conduction(mesh, materials_of(mesh, material), fe::node_pattern(mesh));
  const IndexMatrix& nodes = mesh.cells[0].nodes;
  const Eigen::Index n = mesh.nodes.rows();
  Eigen::VectorXd q = Eigen::VectorXd::Zero(n);
  for_each_mass_point(mesh, mesh.cells[0], 6.0 * kPi * kPi,
                      [&](Eigen::Index c, const auto& N, const Eigen::Vector3d& x, double dm) {
                        for (Eigen::Index a = 0; a < N.size(); ++a)
                          q(nodes(c, a)) += dm * N(a) * hill(x);
                      });
  std::vector<bool> fixed(static_cast<size_t>(n), false);
  for (const int32_t node : mesh::nodes_of(mesh.surface("skin"))) fixed[node] = true;
  const Eigen::VectorXd T = solve_fixed(K, q, fixed, Eigen::VectorXd::Zero(n));
  double square = 0.0;
  for_each_mass_point(mesh, mesh.cells[0], 1.0,
                      [&](Eigen::Index c, const auto& N, const Eigen::Vector3d& x, double dm) {
                        double at = -hill(x);
                        for (Eigen::Index a = 0; a < N.size(); ++a) at += N(a) * T(nodes(c, a));
                        square += dm * at * at;
                      });
  return std::sqrt(square);
}

TEST(HeatOrder, IsTwoWithLinearAndThreeWithQuadraticCells) {
  for (const CellType type : kAllCells) {
    const bool linear = mesh::traits(type).nodes == mesh::traits(type).corners;
    const int cells = linear ? 4 : 2;
    const double rate = std::log2(cube_error(type, cells) / cube_error(type, 2 * cells));
    EXPECT_GT(rate, linear ? 1.8 : 2.7) << mesh::traits(type).name;
    EXPECT_LT(rate, linear ? 2.3 : 3.6) << mesh::traits(type).name;
  }
}

/// Hollow cylinder between a film inside and one outside; the largest error at its nodes [K].
/// T = T_i + Q' ( 1 / (2 pi a h_i) + ln(r / a) / (2 pi k) ), Q' = heat per length.
double cylinder_error(CellType type, int cells) {
  const double a = 0.05, b = 0.1, k = 50.0, h_inner = 600.0, h_outer = 4000.0;
  BlockOptions options;
  options.type = type;
  options.curved = true;
  options.wrap_x = true;
  const mesh::Mesh mesh = block_mesh({12 * cells, 2 * cells, 1}, ring(a, b, 0.02), options);
  const fe::FeModel model = build_all(mesh, R"(
[material.iron]
regions = ["body"]
E = 1.1e11
nu = 0.26
rho = 7200.0
conductivity = 50.0
[[heat]]
name = "warm"
[[heat.film]]
surface = "y0"
coefficient = 600.0
temperature_c = 800.0
[[heat.film]]
surface = "y1"
coefficient = 4000.0
temperature_c = 90.0
)")
                                .model;
  const double per_length =
      -710.0 * 2.0 * kPi / (1.0 / (a * h_inner) + std::log(b / a) / k + 1.0 / (b * h_outer));
  double worst = 0.0;
  for (Eigen::Index node = 0; node < model.nodes.rows(); ++node) {
    const double r = model.nodes.row(node).head<2>().norm();
    if (type == CellType::kHex8 && (r < a - 1e-12 || r > b + 1e-12)) continue;
    const double exact =
        1073.15 + per_length / (2.0 * kPi) * (1.0 / (a * h_inner) + std::log(r / a) / k);
    worst = std::max(worst, std::abs(model.heat.at("warm").temperature(node) - exact));
  }
  return worst;
}

TEST(HeatOrder, AHollowCylinderBetweenFilmsHasTheLogarithmicProfile) {
  const double linear = cylinder_error(CellType::kHex8, 2);
  const double quadratic = cylinder_error(CellType::kHex20, 2);
  EXPECT_LT(linear, 2.0);  // of 500 K between inside and outside
  EXPECT_LT(quadratic, 0.02);
  const double linear_rate = std::log2(cylinder_error(CellType::kHex8, 1) / linear);
  EXPECT_GT(linear_rate, 1.8);
  EXPECT_LT(linear_rate, 2.3);
  // At nodes quadratic cells are at least of third order.
  EXPECT_GT(std::log2(cylinder_error(CellType::kHex20, 1) / quadratic), 2.8);
}

}  // namespace
}  // namespace clatter::assembly::testing
