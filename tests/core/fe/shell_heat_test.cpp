// SPDX-License-Identifier: GPL-3.0-or-later
// Warm shells: free expansion without stress, the forces of held sheets.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/fe/shell_directors.hpp"
#include "shell_meshes.hpp"

namespace clatter::fe::testing {
namespace {

constexpr double kWarm = 1.2e-3;  // alpha dT
const Plate kWarmPlate{.E = 3.0, .nu = 0.3, .thickness = 0.1};
const double kHeld = kWarmPlate.E * kWarmPlate.thickness * kWarm / (1.0 - kWarmPlate.nu);  // N

/// Plane and no parallelogram.
ShellCell warm_cell(int n) {
  ShellNodes x(4, 3);
  x << 0.0, 0.0, 0.0, 1.2, 0.1, 0.0, 1.0, 0.9, 0.0, -0.1, 1.1, 0.0;
  ShellCell cell = cell_alone(x.topRows(n), kWarmPlate);
  cell.axis = Eigen::Vector3d::UnitX();
  return cell;
}

class WarmShell : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Cells, WarmShell, ::testing::Values(3, 4));

TEST_P(WarmShell, PushesItsSidesOutward) {
  // N = E t alpha dT / (1 - nu) on a side of length l: N l / 2 on each of its nodes, and the moment
  // of these about nodes below the sheet.
  const int n = GetParam();
  ShellCell cell = warm_cell(n);
  cell.offset = 0.05;
  const Eigen::Vector3d V = Eigen::Vector3d::UnitZ();
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(6 * n);
  for (int i = 0; i < n; ++i)
    for (const int node : {i, (i + 1) % n}) {
      const Eigen::Vector3d side = cell.x.row((i + 1) % n) - cell.x.row(i);
      const Eigen::Vector3d force = 0.5 * kHeld * side.cross(V);
      exact.segment<3>(6 * node) += force;
      exact.segment<3>(6 * node + 3) += cell.offset * V.cross(force);
    }
  const Eigen::VectorXd force = shell_thermal_force(cell, Eigen::VectorXd::Constant(n, kWarm));
  EXPECT_LE((force - exact).cwiseAbs().maxCoeff(), 1e-14 * kHeld);
}

TEST_P(WarmShell, IsHeldByMomentsWhereItsSectionCouples) {
  // B = c A: forces do the work N by a unit strain, c N by a unit curvature (w = -x^2 / 2).
  constexpr double c = 0.02;
  const int n = GetParam();
  ShellCell cell = warm_cell(n);
  cell.stiffness.B = c * cell.stiffness.A;
  double area = 0.0;
  Eigen::VectorXd stretched = Eigen::VectorXd::Zero(6 * n), bent = stretched;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d at = cell.x.row(i), next = cell.x.row((i + 1) % n);
    area += 0.5 * at.cross(next)(2);
    stretched(6 * i) = at(0);
    bent(6 * i + 2) = -0.5 * at(0) * at(0);
    bent(6 * i + 4) = at(0);
  }
  const Eigen::VectorXd force = shell_thermal_force(cell, Eigen::VectorXd::Constant(n, kWarm));
  EXPECT_NEAR(force.dot(stretched), kHeld * area, 1e-13 * kHeld);
  EXPECT_NEAR(force.dot(bent), c * kHeld * area, 1e-13 * kHeld);
}

/// Of the strains that cause stress, at a point of each cell.
double largest_strain(const Sheet& s, const Plate& plate, const Eigen::VectorXd& u,
                      const Eigen::VectorXd& warm) {
  const std::vector<RowMatrix> directors = shell_directors(s.nodes, s.shells);
  double most = 0.0;
  for (size_t b = 0; b < s.shells.size(); ++b)
    for (Eigen::Index c = 0; c < s.shells[b].nodes.rows(); ++c) {
      const ShellCell cell = cell_of(s, directors, plate, b, c);
      const Eigen::Index n = cell.x.rows();
      Eigen::VectorXd own(6 * n);
      for (Eigen::Index i = 0; i < n; ++i)
        own.segment<6>(6 * i) = u.segment<6>(6 * s.shells[b].nodes(c, i));
      const ShellStrains e = shell_strains(cell, own, {0.3, 0.3}, warm(s.shells[b].nodes.row(c)));
      most =
          std::max({most, e.membrane.norm(), plate.thickness * e.curvature.norm(), e.shear.norm()});
    }
  return most;
}

/// Nodal forces of all cells.
Eigen::VectorXd forces_of(const Sheet& s, const Plate& plate, const Eigen::VectorXd& warm) {
  const std::vector<RowMatrix> directors = shell_directors(s.nodes, s.shells);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(6 * s.nodes.rows());
  for (size_t b = 0; b < s.shells.size(); ++b)
    for (Eigen::Index c = 0; c < s.shells[b].nodes.rows(); ++c) {
      const auto nodes = s.shells[b].nodes.row(c);
      const Eigen::VectorXd own =
          shell_thermal_force(cell_of(s, directors, plate, b, c), warm(nodes));
      for (Eigen::Index i = 0; i < nodes.size(); ++i)
        f.segment<6>(6 * nodes(i)) += own.segment<6>(6 * i);
    }
  return f;
}

class WarmSheet : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, WarmSheet,
                         ::testing::Values(Cells::kQuads, Cells::kTriangles, Cells::kMixed));

/// Six displacements of three corners.
std::vector<int> held_as_a_body(const Sheet& s) {
  return joined({dofs_where(s, {0, 1, 2}, [](double u, double v) { return u == 0.0 && v == 0.0; }),
                 dofs_where(s, {1, 2}, [](double u, double v) { return u == 1.0 && v == 0.0; }),
                 dofs_where(s, {2}, [](double u, double v) { return u == 0.0 && v == 1.0; })});
}

TEST_P(WarmSheet, FreeOnDistortedCellsItGrowsEvenly) {
  const Plate plate{.E = 2e11, .nu = 0.3, .thickness = 0.002};
  const auto vault = [](double u, double v) {
    return Eigen::Vector3d(0.3 * u, 0.2 * v, 0.1 * u * u - 0.05 * u * v);
  };
  const auto flat = [](double u, double v) { return Eigen::Vector3d(0.3 * u, 0.2 * v, 0.0); };
  for (const Map& map : {Map(flat), Map(vault)}) {
    const Sheet s = mapped(map, 4, 4, GetParam(), true);
    const Eigen::VectorXd warm = Eigen::VectorXd::Constant(s.nodes.rows(), kWarm);
    Eigen::VectorXd exact = Eigen::VectorXd::Zero(6 * s.nodes.rows());
    for (Eigen::Index i = 0; i < s.nodes.rows(); ++i)
      exact.segment<3>(6 * i) = kWarm * s.nodes.row(i).transpose();
    const Eigen::VectorXd u =
        solve(assemble(s, plate).K, forces_of(s, plate, warm), held_as_a_body(s), exact);
    EXPECT_LE((u - exact).cwiseAbs().maxCoeff(), 1e-9 * kWarm);  // rounding, (L/t)^2 of it
    EXPECT_LE(largest_strain(s, plate, u, warm), 1e-10 * kWarm);
  }
}

TEST(WarmStrip, OfLinearTemperatureHasNoStress) {
  // alpha dT = a x: u = a (x^2 - y^2) / 2, v = a x y causes none. Rectangles have it at their
  // nodes, their enhanced strains are linear; both nodes at x = 0 move alike.
  const Plate plate{.E = 2e11, .nu = 0.3, .thickness = 0.002};
  constexpr double a = 4e-3, kLength = 0.4, kWidth = 0.05;  // a [1/m]
  const Sheet s = mapped(
      [](double u, double v) { return Eigen::Vector3d(kLength * u, kWidth * (v - 0.5), 0.0); }, 8,
      1, Cells::kQuads);
  const Eigen::VectorXd warm = a * s.nodes.col(0);
  const Eigen::VectorXd u =
      solve(assemble(s, plate).K, forces_of(s, plate, warm),
            dofs_where(s, {0, 1, 2, 3, 4}, [](double at, double) { return at == 0.0; }),
            Eigen::VectorXd::Zero(6 * s.nodes.rows()));
  double error = 0.0;
  for (Eigen::Index i = 0; i < s.nodes.rows(); ++i) {
    const double x = s.nodes(i, 0), y = s.nodes(i, 1);
    error = std::max(error, std::abs(u(6 * i) - 0.5 * a * x * x));
    error = std::max(error, std::abs(u(6 * i + 1) - a * x * y));
  }
  EXPECT_LE(error, 1e-10 * a * kLength * kLength);
  EXPECT_LE(largest_strain(s, plate, u, warm), 1e-10 * a * kLength);
}

}  // namespace
}  // namespace clatter::fe::testing
