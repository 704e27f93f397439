// SPDX-License-Identifier: GPL-3.0-or-later
// The geometric stiffness of shells.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/fe/prestress.hpp"
#include "core/fe/shell_directors.hpp"
#include "shell_meshes.hpp"

namespace clatter::fe::testing {
namespace {

class PrestressOfShells : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, PrestressOfShells,
                         ::testing::Values(Cells::kQuads, Cells::kTriangles, Cells::kQuads8,
                                           Cells::kTriangles6));

/// Of all cells, with the motion `u` (6 a node); lower triangle.
Sparse geometric(const Sheet& sheet, const Plate& plate, const Eigen::VectorXd& u) {
  const std::vector<RowMatrix> directors = shell_directors(sheet.nodes, sheet.shells);
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t b = 0; b < sheet.shells.size(); ++b) {
    const mesh::ShellBlock& block = sheet.shells[b];
    const Eigen::Index n = block.nodes.cols();
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      Eigen::VectorXd own(6 * n);
      for (Eigen::Index a = 0; a < n; ++a)
        own.segment<6>(6 * a) = u.segment<6>(6 * block.nodes(c, a));
      const ShellMatrix G =
          shell_geometric_stiffness(cell_of(sheet, directors, plate, b, c), own, {});
      for (Eigen::Index i = 0; i < 6 * n; ++i)
        for (Eigen::Index j = 0; j < 6 * n; ++j) {
          const auto row = 6 * block.nodes(c, i / 6) + i % 6;
          const auto column = 6 * block.nodes(c, j / 6) + j % 6;
          if (row >= column) entries.emplace_back(row, column, G(i, j));
        }
    }
  }
  Sparse out(6 * sheet.nodes.rows(), 6 * sheet.nodes.rows());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Sheet rectangle(Cells cells, double a, double b, int nu, int nv, bool distorted) {
  return mapped([=](double u, double v) { return Eigen::Vector3d(a * u, b * v, 0.0); }, nu, nv,
                cells, distorted);
}

/// u = A x of nodes that do not turn.
Eigen::VectorXd linear(const Sheet& sheet, const Eigen::Matrix<double, 3, 2>& A) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * sheet.nodes.rows());
  for (Eigen::Index i = 0; i < sheet.nodes.rows(); ++i)
    u.segment<3>(6 * i) = A * sheet.nodes.row(i).head<2>().transpose();
  return u;
}

// Beside a constant force N the energy of u = A x is area N : A^T A / 2, wherever the nodes are
// beside the mid-surface.
TEST_P(PrestressOfShells, AConstantForceIsExactOnDistortedCells) {
  for (const double offset : {0.0, 0.02}) {
    const Plate plate{.E = 2e11, .nu = 0.3, .thickness = 0.01, .offset = offset};
    const Sheet sheet = rectangle(GetParam(), 0.8, 0.5, 3, 3, true);
    Eigen::Matrix<double, 3, 2> strain = Eigen::Matrix<double, 3, 2>::Zero();
    strain.topRows<2>() << 1e-3, 3e-4, 3e-4, -4e-4;
    const double C = plate.E * plate.thickness / (1.0 - 0.09);
    Eigen::Matrix2d N;
    N << C * (1e-3 - 0.3 * 4e-4), C * 0.35 * 6e-4, C * 0.35 * 6e-4, C * (-4e-4 + 0.3 * 1e-3);
    Eigen::Matrix<double, 3, 2> A;
    A << 1.0, 0.3, -0.2, 0.5, -0.7, 0.4;
    const Eigen::VectorXd motion = linear(sheet, A);
    const Sparse G = geometric(sheet, plate, linear(sheet, strain));
    EXPECT_NEAR(motion.dot(times(G, motion).col(0)) / (0.4 * (A * N * A.transpose()).trace()), 1.0,
                1e-10)
        << offset;
  }
}

// Of a square plate on four hinged sides, pressed along x: f^2 goes with 1 - N / N_c to zero at
// N_c = 4 pi^2 D / a^2 (Timoshenko and Gere, "Theory of Elastic Stability", 9.2).
TEST_P(PrestressOfShells, APressedPlateVibratesAsTheory) {
  const double a = 0.5, t = 0.002, E = 2e11, nu = 0.3;
  const Plate plate{.E = E, .nu = nu, .rho = 7800.0, .thickness = t};
  const bool quadratic = GetParam() == Cells::kQuads8 || GetParam() == Cells::kTriangles6;
  const int n = quadratic ? 8 : 16;
  const Sheet sheet = rectangle(GetParam(), a, a, n, n, false);
  const double D = E * t * t * t / (12.0 * (1.0 - nu * nu));
  const double critical = 4.0 * std::numbers::pi * std::numbers::pi * D / (a * a);
  // A free plate under N along x: no stress across.
  Eigen::Matrix<double, 3, 2> strain = Eigen::Matrix<double, 3, 2>::Zero();
  strain(0, 0) = -critical / (E * t);
  strain(1, 1) = nu * critical / (E * t);
  const Sparse G = geometric(sheet, plate, linear(sheet, strain));
  const SheetMatrices free = assemble(sheet, plate);
  const auto is_side = [](double u, double v) {
    return u < 1e-9 || u > 1.0 - 1e-9 || v < 1e-9 || v > 1.0 - 1e-9;
  };
  const auto everywhere = [](double, double) { return true; };
  const std::vector<int> fixed =
      joined({dofs_where(sheet, {2}, is_side), dofs_where(sheet, {0, 1}, everywhere)});
  const double f0 = frequencies(free, fixed, 1, 20.0)(0);
  for (const double share : {-1.0, 0.5, 0.9}) {
    SheetMatrices pressed = free;
    pressed.K += share * G;
    const double f = frequencies(pressed, fixed, 1, 20.0)(0);
    EXPECT_NEAR(f / f0, std::sqrt(1.0 - share), 0.01) << share;
  }
}

}  // namespace
}  // namespace clatter::fe::testing
