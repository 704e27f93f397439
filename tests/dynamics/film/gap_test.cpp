// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/film/gap.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

PadGrid pad() { return PadGrid::uniform(-0.6, 0.6, 9, -0.03, 0.02, 7, 0.05); }

// Patches all around; axis may point down and angles may start anywhere.
rom::ContactGrid ring(int n_a, int n_z, double low, double high, bool upside_down) {
  rom::ContactGrid grid;
  grid.radius = 0.05;
  grid.axis_point = {0.3, 0.0, upside_down ? high : low};
  grid.axis = {0.0, 0.0, upside_down ? -1.0 : 1.0};
  grid.zero_angle = Eigen::Vector3d(0.6, 0.8, 0.0);
  grid.angle = Eigen::VectorXd::LinSpaced(n_a, std::numbers::pi / n_a,
                                          2 * std::numbers::pi - std::numbers::pi / n_a);
  grid.angle_edges.resize(2 * n_a);
  for (int i = 0; i < n_a; ++i)
    grid.angle_edges.segment<2>(2 * i) << 2 * std::numbers::pi * i / n_a,
        2 * std::numbers::pi * (i + 1) / n_a;
  grid.axial_edges = Eigen::VectorXd::LinSpaced(n_z + 1, 0.0, high - low);
  grid.axial = 0.5 * (grid.axial_edges.head(n_z) + grid.axial_edges.tail(n_z));
  return grid;
}

// Mean radial displacement of each patch under rigid motions: normals averaged over the strip.
Eigen::MatrixXd patch_rigid(const rom::ContactGrid& grid) {
  const auto n_a = grid.angle.size(), n_z = grid.axial.size();
  Eigen::MatrixXd rigid(n_a * n_z, 6);
  const Eigen::Vector3d across = grid.axis.cross(grid.zero_angle);
  for (int i = 0; i < n_a; ++i)
    for (int j = 0; j < n_z; ++j) {
      const double half = 0.5 * (grid.angle_edges[2 * i + 1] - grid.angle_edges[2 * i]);
      const Eigen::Vector3d n =
          (std::cos(grid.angle[i]) * grid.zero_angle + std::sin(grid.angle[i]) * across) *
          std::sin(half) / half;
      const double z = grid.axis_point.z() + grid.axis.z() * grid.axial[j];
      rigid.row(i * n_z + j) << n.x(), n.y(), 0.0, -z * n.y(), z * n.x(), 0.3 * n.y();
    }
  return rigid;
}

/// Values of patches and of the motion that fits them, the columns of the map.
Eigen::VectorXd with_fit(const ElasticSurface& surface, const Eigen::VectorXd& patches) {
  Eigen::VectorXd all(patches.size() + kFits);
  all << patches, rigid_fit(surface) * patches;
  return all;
}

TEST(PatchMap, RigidMotionsAreExactAtTheCellsForAnyOrientationOfTheGrid) {
  for (bool upside_down : {false, true}) {
    ElasticSurface surface{ring(10, 6, 0.1, 0.3, upside_down), {}};
    surface.rigid = patch_rigid(surface.grid);
    PatchMap map(surface, pad());
    SparseRows weights;
    for (double offset : {0.15, 0.2031, 0.29}) {
      map.at(offset, weights);
      const RowMatrix cells = rigid_radial(pad(), offset);
      for (int motion : {0, 1, 3, 4})
        EXPECT_LT((weights * with_fit(surface, surface.rigid.col(motion)) - cells.col(motion))
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-12);  // rounding
    }
  }
}

TEST(PatchMap, SmoothFieldsAreInterpolatedToSecondOrder) {
  double last = 0.0;
  for (int n : {12, 24, 48}) {
    const ElasticSurface surface{ring(n, n / 2, 0.0, 0.2, false), {}};
    const rom::ContactGrid& grid = surface.grid;
    Eigen::VectorXd field(n * n / 2);
    auto value = [](double angle, double z) { return std::cos(2 * angle) * (1.0 + 30.0 * z * z); };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n / 2; ++j) field[i * n / 2 + j] = value(grid.angle[i], grid.axial[j]);
    PatchMap map(surface, pad());
    SparseRows weights;
    map.at(0.1, weights);
    const Eigen::VectorXd cells = weights * with_fit(surface, field);
    double error = 0.0;
    for (int i = 0; i < pad().n_angle(); ++i) {
      const Eigen::Vector3d n_vec = pad_normal(pad().angle(i));
      const double angle =
          std::atan2(n_vec.dot(grid.axis.cross(grid.zero_angle)), n_vec.dot(grid.zero_angle));
      for (int j = 0; j < pad().n_axial(); ++j)
        error =
            std::max(error, std::abs(cells[pad().cell(i, j)] - value(angle, pad().axial(j) + 0.1)));
    }
    if (last > 0.0) {
      EXPECT_GT(std::log2(last / error), 1.6);
    }
    last = error;
  }
  EXPECT_LT(last, 0.01);
}

TEST(PatchMap, SlopeIsTheDerivativeAlongTheStroke) {
  const ElasticSurface surface{ring(8, 5, 0.0, 0.2, true), {}};
  PatchMap map(surface, pad());
  SparseRows low, high, weights, slope;
  const double at = 0.1013, d = 1e-7;  // no cell crosses a patch centre within d
  map.at(at - d, low);
  map.at(at + d, high);
  map.at(at, weights, &slope);
  const Eigen::MatrixXd difference = Eigen::MatrixXd(high) - Eigen::MatrixXd(low);
  EXPECT_LT((Eigen::MatrixXd(slope) - difference / (2 * d)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(PatchMap, PatchesOfTwoSectorsDoNotReachAcrossTheSpaceBetween) {
  rom::ContactGrid grid = ring(8, 4, -0.03, 0.02, false);
  grid.zero_angle = Eigen::Vector3d::UnitY();
  grid.angle.resize(4);
  grid.angle << -0.3, 0.3, std::numbers::pi - 0.3, std::numbers::pi + 0.3;
  grid.angle_edges.resize(8);
  grid.angle_edges << -0.6, 0.0, 0.0, 0.6, std::numbers::pi - 0.6, std::numbers::pi,
      std::numbers::pi, std::numbers::pi + 0.6;
  const CylinderStencil stencil(grid.angle, {1, 0, 1, 0}, grid.axial);
  EXPECT_EQ(stencil.at_angle(0.55).first, 1);
  EXPECT_EQ(stencil.at_angle(0.55).weight, 0.0);
  EXPECT_NEAR(stencil.at_angle(0.15).weight, 0.75, 1e-12);
  const ElasticSurface surface{grid, {}};
  PatchMap map(surface, pad());
  SparseRows weights;
  map.at(0.0, weights);
  const RowMatrix cells = rigid_radial(pad());
  Eigen::VectorXd lift(16);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) lift[i * 4 + j] = std::cos(grid.angle[i]);
  EXPECT_LT((weights * with_fit(surface, lift) - cells.col(1)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SkirtShape, ReliefIsZeroAtTheApexAndKnownAtTheEnds) {
  const PadGrid fine = PadGrid::uniform(-0.7, 0.7, 101, -0.03, 0.02, 500, 0.05);
  SkirtShape shape;
  shape.barrel_apex = -0.005;
  shape.barrel_top = 30e-6;
  shape.barrel_bottom = 20e-6;
  shape.ovality = 40e-6;
  const Eigen::ArrayXd relief = skirt_relief(shape, fine);
  EXPECT_GE(relief.minCoeff(), 0.0);
  EXPECT_NEAR(relief[fine.cell(50, 250)], 0.0, 1e-9);  // apex at the middle
  EXPECT_NEAR(relief[fine.cell(50, 499)], 30e-6, 0.3e-6);
  EXPECT_NEAR(relief[fine.cell(50, 0)], 20e-6, 0.3e-6);
  const double s = std::sin(fine.angle(0));
  EXPECT_NEAR(relief[fine.cell(0, 250)], 40e-6 * s * s, 1e-9);
}

TEST(SkirtShape, TableIsReadLinearlyAndMustAscend) {
  SkirtShape shape;
  shape.table_height = {-0.03, 0.0, 0.02};
  shape.table_relief = {30e-6, 0.0, 10e-6};
  const Eigen::ArrayXd relief = skirt_relief(shape, pad());
  for (int j = 0; j < pad().n_axial(); ++j) {
    const double z = pad().axial(j);
    EXPECT_NEAR(relief[pad().cell(4, j)], z < 0 ? -1e-3 * z : 0.5e-3 * z, 1e-15);
  }
  shape.table_height[1] = -0.04;
  test::expect_parts(
      test::refusal_of([&] { skirt_relief(shape, pad()); }),
      {"skirt profile: height 1 is -0.04 m after -0.03 m, expected ascending heights"});
}

TEST(PadGrid, RefusesEdgesThatDoNotAscend) {
  test::expect_parts(test::refusal_of([&] { PadGrid::uniform(0.0, 1.0, 0, 0.0, 1.0, 3, 1.0); }),
                     {"film grid: found 0 x 3 cells, expected at least 1 x 1"});
  test::expect_parts(test::refusal_of([&] { PadGrid::uniform(0.0, -1.0, 3, 0.0, 1.0, 3, 1.0); }),
                     {"film grid: ", "edge 1 is -0.33", ", expected more than 0"});
  test::expect_parts(
      test::refusal_of([&] { PadGrid::uniform(0.0, 1.0, 3, 0.0, 1.0, 3, 1.0, true); }),
      {"film grid: periodic span: found 1 rad, expected 2 pi"});
}

TEST(PadGrid, AreasSumToThePad) { EXPECT_NEAR(pad().area().sum(), 1.2 * 0.05 * 0.05, 1e-15); }

}  // namespace
}  // namespace clatter::film
