// SPDX-License-Identifier: GPL-3.0-or-later
// Poor cells: true against estimated effect, and when a mesh is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/repair/poor_cell_effect.hpp"
#include "mesh/repair/poor_cells.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/assembly/small_solver.hpp"

namespace clatter::mesh {
namespace {

namespace fe = assembly::testing;

Eigen::VectorXd clamped_hz(const Mesh& mesh) {
  const auto model = fe::build(mesh, "[[support]]\nsurface = 'x0'\n").model;
  return fe::lowest_hz(model.K, model.M, 8);
}

/// Moves mid-side nodes of every n-th edge along it to `share` of its length; no two of these edges
/// have a corner in common. 0.25 folds the cells at that corner.
Mesh squeezed(Mesh mesh, int every, double share) {
  std::set<int32_t> used;
  int count = 0;
  for (const auto& cell : mesh.cells[0].nodes.rowwise())
    for (size_t e = 0; e < 6; ++e) {
      const int32_t a = cell(kTetEdges[e][0]), b = cell(kTetEdges[e][1]);
      if (used.contains(a) || used.contains(b) || count++ % every != 0) continue;
      used.insert({a, b});
      mesh.nodes.row(cell(4 + static_cast<Eigen::Index>(e))) =
          (1.0 - share) * mesh.nodes.row(a) + share * mesh.nodes.row(b);
    }
  return mesh;
}

PoorCells poor_cells_of(const Mesh& mesh) { return find_poor_cells(mesh, measure_quality(mesh)); }

// A plate of one and a bar of three layers of cells. The estimate has the mean bending of the part;
// modes differ in where they bend: measured on plate, bar and tube with 1 to 25 spoiled edges
// (mesh/README.md) it was 0.3 to 5 times the largest change, 2 in the median.
TEST(PoorCells, HardG8_EstimatedEffectIsThatOnFrequenciesWithinAFactorOfFive) {
  struct Case {
    std::array<int, 3> n;
    Eigen::Vector3d size;
    int every;
    double share;
  };
  for (const Case& c : {Case{{12, 6, 1}, {0.12, 0.06, 0.004}, 40, 0.27},
                        Case{{12, 6, 1}, {0.12, 0.06, 0.004}, 5, 0.255},
                        Case{{12, 3, 2}, {0.12, 0.03, 0.02}, 10, 0.27}}) {
    const Mesh good = fe::block_mesh(c.n, fe::brick(c.size));
    EXPECT_EQ(poor_cells_of(good).cells, 0);
    const Mesh spoiled = squeezed(good, c.every, c.share);
    const PoorCells poor = poor_cells_of(spoiled);
    ASSERT_GT(poor.squeezed, 0);
    EXPECT_EQ(poor.flat, 0);
    const double largest =
        (clamped_hz(spoiled).array() / clamped_hz(good).array() - 1.0).maxCoeff();
    EXPECT_GT(largest, 1e-5);  // far above rounding: there is an effect to estimate
    EXPECT_GT(poor.frequency_effect, 0.2 * largest);
    EXPECT_LT(poor.frequency_effect, 5.0 * largest);
    EXPECT_GT(poor.most_effect(), largest);
  }
}

/// One inner corner of a straight-edged mesh moves to `share` of its height above the opposite face
/// of a cell, the first that inverts no other cell.
Mesh flattened(const Mesh& good, double share) {
  Mesh flat = good;
  std::set<int32_t> outer;
  for (const int32_t node : nodes_of(flat.surface("skin"))) outer.insert(node);
  const IndexMatrix& cells = flat.cells[0].nodes;
  for (Eigen::Index c = 0; c < cells.rows(); ++c)
    for (int top = 0; top < 4; ++top) {
      if (outer.contains(cells(c, top))) continue;
      Eigen::RowVector3d foot = Eigen::RowVector3d::Zero();
      for (int i = 0; i < 4; ++i)
        if (i != top) foot += good.nodes.row(cells(c, i)) / 3.0;
      flat.nodes.row(cells(c, top)) = foot + share * (good.nodes.row(cells(c, top)) - foot).eval();
      for (const auto& cell : cells.rowwise())
        for (size_t e = 0; e < 6; ++e)
          flat.nodes.row(cell(4 + static_cast<Eigen::Index>(e))) =
              0.5 * (flat.nodes.row(cell(kTetEdges[e][0])) + flat.nodes.row(cell(kTetEdges[e][1])));
      if (check_validity(flat).invalid.empty()) return flat;
      flat.nodes = good.nodes;
    }
  ADD_FAILURE() << "no cell could be flattened";
  return good;
}

// Angles of 0.1 deg. Quadratic cells with straight edges have every quadratic field, however flat.
TEST(PoorCells, HardG8_FlatStraightCellsHardlyMoveFrequenciesAndTheEstimateSaysSo) {
  const Mesh good = fe::block_mesh({6, 3, 3}, fe::brick({0.06, 0.03, 0.03}));
  const Mesh flat = flattened(good, 1e-3);
  const PoorCells poor = poor_cells_of(flat);
  EXPECT_GT(poor.flat, 0);
  EXPECT_GT(poor.below_floor, 0);
  EXPECT_EQ(poor.squeezed, 0);
  EXPECT_LT(poor.frequency_effect, 1e-9);  // rounding over heights of a thousandth
  const double largest =
      (clamped_hz(flat).array() / clamped_hz(good).array() - 1.0).abs().maxCoeff();
  EXPECT_LT(largest, 2e-3);  // cells around became larger; nothing of the size of 0.1 deg
}

// The angle falls from 0.1 to 1e-4 deg: neither refused, and the frequencies stay, also in
// rounding.
TEST(HardG11Effect, SliversAmongGoodCellsPassAndTheFrequenciesConfirmIt) {
  const Mesh good = fe::block_mesh({6, 3, 3}, fe::brick({0.06, 0.03, 0.03}));
  const Mesh flat = flattened(good, 1e-3), flatter = flattened(good, 1e-6);
  for (const Mesh* mesh : {&flat, &flatter}) {
    const PoorCells poor = poor_cells_of(*mesh);
    EXPECT_GT(poor.below_floor, 0);
    EXPECT_LT(poor.most_effect(), 0.01);
    EXPECT_GT(poor.most_effect(),
              (clamped_hz(*mesh).array() / clamped_hz(good).array() - 1.0).abs().maxCoeff());
    EXPECT_EQ(refusal_of_poor_cells(poor, *mesh, kQualityAims, {}, false), "");
  }
  EXPECT_LT(measure_quality(flatter).min_dihedral_deg.worst, 3e-4);
}

// Quadratic polynomials are exact in a foil of flat cells too; but it locks, as slopes cannot be
// continuous across edges that are not parallel, and rounding has the size of its stiffness.
TEST(HardG11Effect, AFoilOfFlatCellsIsRefusedAndItsFrequencyIsWrong) {
  const double length = 0.06, thickness = 1.2e-5;
  const Mesh foil = fe::block_mesh({6, 2, 1}, [&](const Eigen::Vector3d& u) -> Eigen::Vector3d {
    const double bent = 0.06 * std::sin(std::numbers::pi * u.x());
    return {length * (u.x() + bent * std::sin(4.0 * u.y())), 0.02 * (u.y() + bent * u.y()),
            thickness * u.z()};
  });
  const PoorCells poor = poor_cells_of(foil);
  EXPECT_LT(poor.frequency_effect, 1e-6);
  EXPECT_NE(refusal_of_poor_cells(poor, foil, kQualityAims, {}, false), "");
  // A clamped plate that cannot contract across.
  const double stiff = 1.875104 * 1.875104 / (2.0 * std::numbers::pi) *
                       std::sqrt(2.1e11 / (12.0 * 7850.0 * (1.0 - 0.09))) * thickness /
                       (length * length);
  EXPECT_FALSE(std::abs(clamped_hz(foil)(0) / stiff - 1.0) <= kMostEffect) << clamped_hz(foil)(0);
}

TEST(PoorCells, TheWorstAreNamedInThePartsUnitAndBelowTheFloorRefused) {
  const Mesh spoiled =
      squeezed(fe::block_mesh({6, 3, 1}, fe::brick({0.06, 0.03, 0.01})), 50, 0.251);
  const PoorCells poor = poor_cells_of(spoiled);
  ASSERT_GT(poor.below_floor, 0);
  const std::string text = describe_poor_cells(poor, spoiled, kQualityAims, {"cm", 1e-2});
  const Eigen::Vector3d position = poor.worst_squeezed.at(0).position / 1e-2;
  EXPECT_NE(text.find(fmt::format("at ({:.5g}, {:.5g}, {:.5g}) cm", position.x(), position.y(),
                                  position.z())),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("estimated effect on frequencies"), std::string::npos) << text;
  EXPECT_EQ(refusal_of_poor_cells(poor, spoiled, kQualityAims, {}, true), "");
  const std::string said = refusal_of_poor_cells(poor, spoiled, kQualityAims, {}, false);
  for (const char* part : {"mm, ", ", at most ", "more than 5 % is too poor to be trusted"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(PoorCells, LinearCellsHaveNoEstimate) {
  fe::BlockOptions linear;
  linear.type = CellType::kTet4;
  Mesh mesh = fe::block_mesh({4, 2, 2}, fe::brick({0.4, 0.2, 0.0005}), linear);
  const PoorCells poor = poor_cells_of(mesh);
  EXPECT_GT(poor.flat, 0);
  EXPECT_FALSE(poor.has_estimate);
  EXPECT_EQ(describe_poor_cells(poor, mesh, kQualityAims, {}).find("estimated"), std::string::npos);
}

}  // namespace
}  // namespace clatter::mesh
