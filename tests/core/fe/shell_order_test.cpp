// SPDX-License-Identifier: GPL-3.0-or-later
// The error of linear shells falls with the square of the size of the cells, that of quadratic
// ones with the fourth power.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shell_meshes.hpp"

namespace clatter::fe::testing {
namespace {

using std::numbers::pi;

/// Work of the pressure sin(pi x) sin(pi y) on a plate with hard simple supports, over the exact
/// one of Mindlin's theory: w = p / (D k^4) (1 + D k^2 / S), k^2 = 2 pi^2.
double relative_work(int n, Cells cells, bool distorted) {
  const Plate plate{.E = 1e9, .nu = 0.3, .thickness = 0.02};
  const Sheet s =
      mapped([](double u, double v) { return Eigen::Vector3d(u, v, 0.0); }, n, n, cells, distorted);
  const SheetMatrices model = assemble(s, plate);
  Eigen::VectorXd pressure = Eigen::VectorXd::Zero(model.K.rows());
  for (Eigen::Index i = 0; i < s.nodes.rows(); ++i)
    pressure(6 * i + 2) = std::sin(pi * s.nodes(i, 0)) * std::sin(pi * s.nodes(i, 1));
  Plate loaded = plate;
  loaded.mass = MassForm::kNodes;
  const Eigen::VectorXd f = times(assemble(s, loaded).M, pressure) / plate.thickness;
  const auto end = [](double a) { return a < 1e-9 || a > 1.0 - 1e-9; };
  const std::vector<int> fixed =
      joined({dofs_where(s, {0, 1, 5}, [](double, double) { return true; }),
              dofs_where(s, {2, 3}, [&](double u, double) { return end(u); }),
              dofs_where(s, {2, 4}, [&](double, double v) { return end(v); })});
  const double work = f.dot(solve(model.K, f, fixed, Eigen::VectorXd::Zero(model.K.rows())));
  const ShellStiffness k = stiffness_of(plate);
  const double k2 = 2.0 * pi * pi;
  return work / (0.25 / (k.D(0, 0) * k2 * k2) * (1.0 + k.D(0, 0) * k2 / k.S(0, 0)));
}

class ShellOrder : public ::testing::TestWithParam<std::tuple<Cells, bool>> {};
INSTANTIATE_TEST_SUITE_P(Cells, ShellOrder,
                         ::testing::Combine(::testing::Values(Cells::kQuads, Cells::kTriangles,
                                                              Cells::kMixed),
                                            ::testing::Bool()));

class QuadraticShellOrder : public ::testing::TestWithParam<std::tuple<Cells, bool>> {};
INSTANTIATE_TEST_SUITE_P(Cells, QuadraticShellOrder,
                         ::testing::Combine(::testing::Values(Cells::kQuads8, Cells::kTriangles6),
                                            ::testing::Bool()));

TEST_P(QuadraticShellOrder, WorkOfAPlateConvergesByTheFourthPower) {
  const auto [cells, distorted] = GetParam();
  const double coarse = std::abs(relative_work(6, cells, distorted) - 1.0);
  const double fine = std::abs(relative_work(12, cells, distorted) - 1.0);
  EXPECT_LE(fine, distorted ? 2e-3 : 2e-4);
  EXPECT_GE(std::log2(coarse / fine), 3.4);
}

TEST_P(ShellOrder, WorkOfAPlateConvergesByTheSquare) {
  const auto [cells, distorted] = GetParam();
  const double coarse = std::abs(relative_work(12, cells, distorted) - 1.0);
  const double fine = std::abs(relative_work(24, cells, distorted) - 1.0);
  EXPECT_LE(fine, distorted ? 0.045 : 0.015);
  EXPECT_GE(std::log2(coarse / fine), 1.8);
}

}  // namespace
}  // namespace clatter::fe::testing
