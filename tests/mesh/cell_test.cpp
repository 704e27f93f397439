// SPDX-License-Identifier: GPL-3.0-or-later
// Node orders, validity and quality against cases that can be checked by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/base/error.hpp"
#include "mesh/repair/quality.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::det_at;
using testing::one_cell;
using testing::reference_tet10;

TEST(Cell, VtkOrderSwapsTheLastTwoNodesAndIsItsOwnInverse) {
  const auto p = traits(CellType::kTet10).to_vtk;
  const std::vector<int> gmsh = {10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
  std::vector<int> vtk, back;
  for (int i : p) vtk.push_back(gmsh[i]);
  EXPECT_EQ(vtk, (std::vector<int>{10, 11, 12, 13, 14, 15, 16, 17, 19, 18}));
  for (int i : p) back.push_back(vtk[i]);
  EXPECT_EQ(back, gmsh);
}

TEST(Cell, MidSideNodesOfFacesLieBetweenTheirCorners) {
  const Tet10Nodes x = reference_tet10();
  for (const auto& face : kTetFaces) {
    for (int e = 0; e < 3; ++e) {
      const auto [a, b] = kTriangleEdges[e];
      EXPECT_EQ(x.row(face[3 + e]), 0.5 * (x.row(face[a]) + x.row(face[b])));
    }
  }
}

TEST(Cell, UnknownNameIsRefusedWithTheKnownOnes) {
  EXPECT_EQ(cell_type_named("tet10", "f"), CellType::kTet10);
  test::expect_parts(test::refusal_of([&] { cell_type_named("hex99", "f"); }),
                     {"f: found cell type 'hex99', expected one of: tet4, ", "hex8"});
}

TEST(Boundary, OneCellIsClosedOutwardAndEnclosesASixth) {
  const Mesh mesh = one_cell();
  const SurfaceIntegrals s = integrate(mesh, mesh.surface("skin"));
  EXPECT_EQ(mesh.surface("skin").face_count(), 4);
  // Rounding of a few dozen products of order one; the quadrature's constants carry 15 digits.
  EXPECT_NEAR(s.enclosed, 1.0 / 6.0, 1e-14);
  EXPECT_NEAR(s.area, 1.5 + std::sqrt(3.0) / 2.0, 1e-14);
  EXPECT_LT(s.normal.norm(), 1e-14);
  EXPECT_EQ(count_inward(mesh, mesh.surface("skin")), 0);
}

TEST(Boundary, HardG9_ReversedTriangleIsCountedAsInward) {
  Mesh mesh = one_cell();
  auto& t = mesh.surfaces["skin"].faces[0].nodes;
  std::swap(t(1, 1), t(1, 2));
  std::swap(t(1, 3), t(1, 5));
  EXPECT_EQ(count_inward(mesh, mesh.surface("skin")), 1);
  EXPECT_GT(integrate(mesh, mesh.surface("skin")).normal.norm(), 0.1);
}

// A thin cell bent over a bore: the middle of its curved face lies on the other side of the middle
// of its corners, and yet the cell is valid and its normal points out.
TEST(Boundary, HardG9_NormalOfAStronglyBentThinCellPointsOut) {
  Mesh mesh = one_cell();
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) {
    auto x = mesh.nodes.row(n);
    const double bump = x(0) * x(1) + (x(0) + x(1)) * (1.0 - x(0) - x(1));
    x(2) = 0.1 * x(2) + bump;  // keeps det J
  }
  const CellNodes x = cell_nodes(mesh, mesh.cells[0], 0);
  ASSERT_GT(jacobian_bounds(CellType::kTet10, x).min, 0.0);
  EXPECT_EQ(count_inward(mesh, mesh.surface("skin")), 0);
}

TEST(Validity, StraightCellHasScaledJacobianOne) {
  const JacobianBounds b = jacobian_bounds(reference_tet10());
  EXPECT_NEAR(b.min, 1.0, 1e-14);   // det J of the reference cell
  EXPECT_NEAR(b.mean, 1.0, 1e-14);  // rounding only
  EXPECT_NEAR(volume_of(reference_tet10()), 1.0 / 6.0, 1e-15);
}

TEST(Validity, BezierBoundIsBelowEverySampleAndVerdictIsRight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.16, 0.16), unit(0.0, 1.0);
  int folded = 0, valid = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Tet10Nodes x = reference_tet10();
    for (int i = 4; i < 10; ++i)
      x.row(i) += Eigen::RowVector3d(shift(random), shift(random), shift(random));
    const JacobianBounds bounds = jacobian_bounds(x);
    double lowest = 1e300;
    for (int s = 0; s < 2000; ++s) {
      Eigen::Vector4d l(unit(random), unit(random), unit(random), unit(random));
      if (s % 2 == 0) l[s / 2 % 4] = 0.0;  // also faces: minima often lie there
      l /= l.sum();
      lowest = std::min(lowest, det_at(x, l));
    }
    for (int i = 0; i < 4; ++i) lowest = std::min(lowest, det_at(x, Eigen::Vector4d::Unit(i)));
    EXPECT_LE(bounds.min, lowest + 1e-12);  // rounding of a cubic with terms of order one
    if (bounds.min > 0.0) ++valid;
    if (lowest < 0.0) {
      ++folded;
      EXPECT_LE(bounds.min, 0.0);
    }
  }
  EXPECT_GT(folded, 20);  // both outcomes occur
  EXPECT_GT(valid, 20);
}

TEST(Validity, HardG2_FoldedCellThatFourGaussPointsCallGoodIsFound) {
  Tet10Nodes x = reference_tet10();
  x(4, 0) = 0.2;  // middle of edge 0-1 pulled below the quarter point: det J < 0 at corner 0
  const double a = 0.58541020, b = 0.13819660;
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector4d l = Eigen::Vector4d::Constant(b);
    l[i] = a;
    EXPECT_GT(det_at(x, l), 0.0);
  }
  EXPECT_LT(det_at(x, Eigen::Vector4d::Unit(0)), 0.0);
  EXPECT_LE(jacobian_bounds(x).ratio(), 0.0);
  const ValidityReport report = check_validity(one_cell(x));
  ASSERT_EQ(report.invalid.size(), 1u);
  EXPECT_NE(describe_invalid(report, 1).find("cell 0 of block 0 at (0.25, 0.25, 0.25) m"),
            std::string::npos);
}

TEST(Quality, RegularTetrahedronHasItsKnownAngles) {
  Eigen::Matrix<double, 4, 3> x;
  x << 1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1;  // positive orientation
  const auto angles = dihedral_angles(x);
  for (int e = 0; e < 6; ++e) EXPECT_NEAR(angles[e], std::acos(1.0 / 3.0) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(radius_ratio(x), 1.0, 1e-14);
}

// Flat, needle-like and plain cells: the shortcut by normals must give the same answer.
TEST(Quality, SmallestAngleByNormalsIsThatOfAllSixToTheLastBit) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int below = 0, above = 0;
  for (int c = 0; c < 4000; ++c) {
    Eigen::Matrix<double, 4, 3> x;
    for (double& value : x.reshaped()) value = unit(random);
    if (c % 4 == 1) x.col(2) *= 1e-7;                                    // flat
    if (c % 4 == 2) x.row(3) = x.row(0) + 1e-9 * (x.row(3) - x.row(1));  // two corners close by
    const double exact = dihedral_angles(x).minCoeff();
    for (const double limit : {0.5, 8.0, 30.0, 180.0}) {
      const double found = smallest_dihedral(x, limit);
      if (exact < limit) {
        EXPECT_EQ(found, exact);
        ++below;
      } else {
        EXPECT_GE(found, limit);
        ++above;
      }
    }
    const double cosine = largest_cosine(x);
    if (!std::isnan(cosine)) {
      EXPECT_NEAR(cosine, std::cos(exact * M_PI / 180.0), kCosineError);
    }
  }
  EXPECT_GT(below, 4000);  // both outcomes occur
  EXPECT_GT(above, 4000);
}

TEST(Quality, WorstCellIsNamedWithItsPosition) {
  const QualityReport q = measure_quality(one_cell());
  EXPECT_NEAR(q.min_dihedral_deg.worst, std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(q.max_dihedral_deg.worst, 90.0, 1e-12);
  EXPECT_NEAR(q.min_dihedral_deg.position.x(), 0.25, 1e-15);
}

}  // namespace
}  // namespace clatter::mesh
