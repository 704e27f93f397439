// SPDX-License-Identifier: GPL-3.0-or-later
// The patch of MacNeal and Harder 1985: constant membrane strain and constant curvature come out
// exactly.
#include <gtest/gtest.h>

#include <array>

#include "core/fe/shell_directors.hpp"
#include "shell_meshes.hpp"
#include "tests/observed.hpp"

namespace clatter::fe::testing {
namespace {

constexpr double kFactor = 1e-3;

/// Four sides, of `across` instead of 0.12, and four nodes inside; five quadrilaterals.
Sheet patch(Cells cells, double across = 0.12) {
  Sheet s{RowMatrix(8, 3), RowMatrix()};
  s.nodes << 0.0, 0.0, 0.0, 0.24, 0.0, 0.0, 0.24, 0.12, 0.0, 0.0, 0.12, 0.0,  //
      0.04, 0.02, 0.0, 0.18, 0.03, 0.0, 0.16, 0.08, 0.0, 0.08, 0.08, 0.0;
  s.nodes.col(1) *= across / 0.12;
  IndexMatrix quads(5, 4);
  quads << 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7, 4, 5, 6, 7;
  s.shells = blocks_of(quads, cells);
  if (cells == Cells::kQuads8 || cells == Cells::kTriangles6) add_middles(s);
  return s;
}

/// u, theta of both fields at once: u = (x + y/2, y + x/2), w = (x^2 + x y + y^2) / 2.
Eigen::VectorXd field(const Sheet& s) {
  Eigen::VectorXd u(6 * s.nodes.rows());
  for (Eigen::Index i = 0; i < s.nodes.rows(); ++i) {
    const double x = s.nodes(i, 0), y = s.nodes(i, 1);
    u.segment<6>(6 * i) << x + 0.5 * y, y + 0.5 * x, 0.5 * (x * x + x * y + y * y), 0.5 * x + y,
        -x - 0.5 * y, 0.0;
  }
  return kFactor * u;
}

/// Largest errors of displacements, and of N and M over the largest of each.
struct PatchError {
  double displacement, membrane, bending;
};

PatchError error_of(const Sheet& s, const Plate& plate) {
  const Eigen::VectorXd exact = field(s);
  std::vector<int> fixed;  // on the four sides
  for (Eigen::Index i = 0; i < s.nodes.rows(); ++i) {
    const auto is_end = [](double a, double end) { return a < 1e-9 || a > end * (1.0 - 1e-9); };
    if (is_end(s.nodes(i, 0), 0.24) || is_end(s.nodes(i, 1), s.nodes(2, 1)))
      for (int d = 0; d < 6; ++d) fixed.push_back(6 * static_cast<int>(i) + d);
  }
  const Eigen::VectorXd u =
      solve(assemble(s, plate).K, Eigen::VectorXd::Zero(exact.size()), fixed, exact);
  PatchError out{(u - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(), 0.0, 0.0};
  const double t = plate.thickness;
  const Eigen::Vector3d N = t * Eigen::Vector3d(4e3 / 3.0, 4e3 / 3.0, 400.0);
  const Eigen::Vector3d M = -t * t * t / 1e-9 * Eigen::Vector3d(1e-6 / 9.0, 1e-6 / 9.0, 1e-7 / 3.0);
  const std::vector<RowMatrix> directors = shell_directors(s.nodes, s.shells);
  for (size_t b = 0; b < s.shells.size(); ++b)
    for (Eigen::Index c = 0; c < s.shells[b].nodes.rows(); ++c) {
      ShellCell cell = cell_of(s, directors, plate, b, c);
      cell.axis = Eigen::Vector3d::UnitX();
      Eigen::VectorXd own(6 * cell.x.rows());
      for (Eigen::Index i = 0; i < cell.x.rows(); ++i)
        own.segment<6>(6 * i) = u.segment<6>(6 * s.shells[b].nodes(c, i));
      for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.7, 0.3)}) {
        const ShellStrains e = shell_strains(cell, own, at);
        const ShellStiffness& k = cell.stiffness;
        out.membrane = std::max(out.membrane, (k.A * e.membrane - N).norm() / N.norm());
        out.bending = std::max(out.bending, (k.D * e.curvature - M).norm() / M.norm());
      }
    }
  return out;
}

class ShellPatch : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, ShellPatch,
                         ::testing::Values(Cells::kQuads, Cells::kTriangles, Cells::kMixed,
                                           Cells::kQuads8, Cells::kTriangles6));

TEST_P(ShellPatch, ConstantStrainAndCurvatureAreExact) {
  const PatchError e = error_of(patch(GetParam()), {.E = 1e6, .nu = 0.25, .thickness = 1e-3});
  EXPECT_LE(e.displacement, 1e-11);
  EXPECT_LE(e.membrane, 1e-11);
  EXPECT_LE(e.bending, 5e-11);  // rounding of the shear, which is (h/t)^2 = 1e4 times as stiff
}

TEST_P(ShellPatch, HardU5_AThinSheetIsNotLocked) {
  // Rounding grows as (h/t)^2, 1e7 here: 4e-8 of the moments is the most seen.
  const PatchError e = error_of(patch(GetParam()), {.E = 1e6, .nu = 0.25, .thickness = 2.4e-5});
  test::expect_at_most("error of the moments at L/t = 1e4", e.bending, 1e-7);
  EXPECT_LE(e.displacement, 1e-7);
  EXPECT_LE(e.membrane, 1e-7);
}

TEST_P(ShellPatch, HardU2_SliversAreExact) {
  // A thousandth of the length: angles down to 0.03 degrees.
  const PatchError e =
      error_of(patch(GetParam(), 2.4e-4), {.E = 1e6, .nu = 0.25, .thickness = 1e-3});
  const bool is_quadratic = GetParam() == Cells::kQuads8 || GetParam() == Cells::kTriangles6;
  const double limit = is_quadratic ? 1e-6 : 1e-8;  // rounding grows with the aspect ratio
  test::expect_at_most("error of the moments in slivers of 1:1000", e.bending, limit);
  EXPECT_LE(e.displacement, limit);
  EXPECT_LE(e.membrane, limit);
}

}  // namespace
}  // namespace clatter::fe::testing
