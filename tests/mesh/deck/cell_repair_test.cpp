// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/cell_repair.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/boundary.hpp"
#include "core/mesh/validity.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/refusal.hpp"

namespace clatter::test {
namespace {

using mesh::CellType;
using mesh::Mesh;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

auto says(const std::string& text) {
  return testing::Field(&mesh::deck::Repair::text, HasSubstr(text));
}

/// The mirror image of a node numbering that another program might write: reversed orientation.
Mesh left_handed(Mesh mesh) {
  mesh.nodes.col(0) *= -1.0;
  return mesh;
}

TEST(CellRepair, LeftHandedCellsOfAllTypesBecomePositiveWithTheSameEdges) {
  for (const CellType type :
       {CellType::kTet4, CellType::kTet10, CellType::kHex8, CellType::kHex20, CellType::kWedge6,
        CellType::kWedge15, CellType::kPyramid5, CellType::kPyramid13}) {
    const Mesh right = assembly::testing::block_mesh(
        {2, 1, 1}, assembly::testing::brick({2.0, 1.0, 1.0}), {.type = type});
    Mesh turned = left_handed(right);
    turned.surfaces["skin"] = right.surfaces.at("skin");
    EXPECT_FALSE(check_validity(turned).invalid.empty());
    EXPECT_THAT(mesh::deck::repair_cells(turned, "t"), ElementsAre(says("are left-handed")))
        << mesh::traits(type).name;
    EXPECT_TRUE(check_validity(turned).invalid.empty()) << mesh::traits(type).name;
    // Mid-side nodes lie on their edges: the volume is exact; faces point outward.
    EXPECT_NEAR(cell_volume(turned), cell_volume(right), 1e-12) << mesh::traits(type).name;
    EXPECT_EQ(count_inward(turned, turned.surfaces.at("skin")), 0) << mesh::traits(type).name;
    EXPECT_THAT(mesh::deck::repair_cells(turned, "t"), IsEmpty());
  }
}

/// One cell of the unit cube's corners; `corners` in our order, mid-side nodes added.
Mesh one_cell(CellType type, std::vector<int32_t> corners) {
  Mesh cell;
  cell.nodes.resize(8, 3);
  cell.nodes << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1;
  cell.regions = {"r"};
  mesh::CellBlock block;
  block.type = type;
  block.ids = {7};
  block.nodes =
      Eigen::Map<const IndexMatrix>(corners.data(), 1, static_cast<Eigen::Index>(corners.size()));
  cell.cells.push_back(block);
  return cell;
}

struct Degenerate {
  CellType from;
  std::vector<int32_t> corners;
  CellType to;
  double volume;
};

TEST(CellRepair, RepeatedNodesMakeSimplerCells) {
  const Degenerate cases[] = {
      {CellType::kHex8, {0, 1, 2, 2, 4, 5, 6, 6}, CellType::kWedge6, 0.5},
      {CellType::kHex8, {0, 0, 1, 2, 4, 4, 5, 6}, CellType::kWedge6, 0.5},
      {CellType::kHex8, {0, 1, 2, 3, 4, 5, 5, 4}, CellType::kWedge6, 0.5},  // roof along an edge
      {CellType::kHex8, {0, 1, 2, 3, 4, 4, 4, 4}, CellType::kPyramid5, 1.0 / 3.0},
      {CellType::kHex8, {0, 1, 2, 2, 4, 4, 4, 4}, CellType::kTet4, 1.0 / 6.0},
      {CellType::kWedge6, {0, 1, 2, 4, 4, 4}, CellType::kTet4, 1.0 / 6.0},
      {CellType::kWedge6, {0, 1, 2, 4, 5, 2}, CellType::kPyramid5, 1.0 / 3.0},
      {CellType::kPyramid5, {0, 1, 2, 2, 4}, CellType::kTet4, 1.0 / 6.0},
  };
  for (const auto& [from, corners, to, volume] : cases) {
    Mesh cell = one_cell(from, corners);
    EXPECT_THAT(mesh::deck::repair_cells(cell, "t"),
                ElementsAre(says("with repeated nodes are read as")));
    ASSERT_EQ(cell.cells.size(), 1u);
    EXPECT_EQ(cell.cells[0].type, to);
    EXPECT_THAT(cell.cells[0].ids, ElementsAre(7));
    EXPECT_TRUE(check_validity(cell).invalid.empty());
    EXPECT_NEAR(cell_volume(cell), volume, 1e-14);
  }
}

TEST(CellRepair, MidSideNodesInAnotherOrderGoToTheEdgesInWhichTheyLie) {
  for (const CellType type :
       {CellType::kTet10, CellType::kHex20, CellType::kWedge15, CellType::kPyramid13}) {
    const Mesh right = assembly::testing::block_mesh(
        {2, 1, 1}, assembly::testing::brick({2.0, 1.0, 1.0}), {.type = type});
    Mesh other = right;
    const int corners = mesh::traits(type).corners;
    auto& nodes = other.cells[0].nodes;
    for (Eigen::Index c = 0; c < nodes.rows();
         c += 2)  // as a writer does that lists them backwards
      nodes.row(c).tail(nodes.cols() - corners).reverseInPlace();
    EXPECT_FALSE(check_validity(other).invalid.empty());
    const auto done = mesh::deck::repair_cells(other, "t");
    ASSERT_THAT(done, ElementsAre(says("lie on other edges than their order says")));
    EXPECT_EQ(done[0].cells, (right.cell_count() + 1) / 2) << mesh::traits(type).name;
    EXPECT_EQ(other.cells[0].nodes, right.cells[0].nodes) << mesh::traits(type).name;
  }
}

TEST(CellRepair, ACurvedCellKeepsItsOrderAndAFoldedOneIsNotGuessed) {
  const Mesh straight = assembly::testing::block_mesh(
      {1, 1, 1}, assembly::testing::brick({1.0, 1.0, 1.0}), {.type = CellType::kHex20});
  Mesh curved = straight;
  curved.nodes(curved.cells[0].nodes(0, 8), 2) += 0.2;  // of an edge of length 1
  EXPECT_THAT(mesh::deck::repair_cells(curved, "t"), IsEmpty());
  Mesh folded = straight;
  folded.nodes(folded.cells[0].nodes(0, 8), 0) += 0.6;  // beyond the edge's end, in no middle
  EXPECT_THAT(mesh::deck::repair_cells(folded, "t"), IsEmpty());
  EXPECT_FALSE(check_validity(folded).invalid.empty());
}

TEST(CellRepair, ACubeWithSevenCornersIsNoCell) {
  Mesh cell = one_cell(CellType::kHex8, {0, 1, 2, 2, 4, 5, 6, 7});
  EXPECT_THAT(refusal_of([&] { mesh::deck::repair_cells(cell, "t.inp"); }),
              HasSubstr("t.inp: cell 7: found a hex8 with repeated nodes that is no wedge"));
}

TEST(CellRepair, SurfacesLoseTheRepeatedNodes) {
  Mesh cell = one_cell(CellType::kHex8, {0, 1, 2, 2, 4, 5, 6, 6});
  mesh::SurfaceBuilder surface;
  surface.add(mesh::FaceType::kQuad4, std::vector<int32_t>{0, 2, 2, 1});  // the collapsed base
  surface.add(mesh::FaceType::kQuad4, std::vector<int32_t>{0, 1, 5, 4});
  cell.surfaces["s"] = surface.finish();
  mesh::deck::repair_cells(cell, "t");
  EXPECT_EQ(cell.surfaces.at("s").face_count(), 2);
  EXPECT_EQ(cell.surfaces.at("s").faces.size(), 2u);  // a triangle and a quadrangle
}

// A quadratic wedge written as CHEXA with 20 grids: the mid-side nodes of collapsed edges are their
// corners, blank ones are made.
TEST(CellRepair, QuadraticOnesKeepTheirMidSideNodes) {
  std::string deck = "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\n";
  const double at[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}};
  for (int i = 0; i < 6; ++i)
    deck += fmt::format("GRID,{},,{:.1f},{:.1f},{:.1f}\n", i + 1, at[i][0], at[i][1], at[i][2]);
  deck += "GRID,7,,.5,0.,0.\n";
  const auto found = read_deck(deck + "CHEXA,1,1,1,2,3,3,4,5,+\n+,6,6,7\nENDDATA\n");
  ASSERT_EQ(found.mesh.cells.size(), 1u);
  EXPECT_EQ(found.mesh.cells[0].type, CellType::kWedge15);
  EXPECT_NEAR(cell_volume(found.mesh), 0.5, 1e-14);
  EXPECT_THAT(found.renumbered,
              testing::Contains(says("1 cells hex20 with repeated nodes are read as wedge15")));
}

TEST(CellRepair, PressureActsOnFacesOfCellsThatWereRepaired) {
  const std::string cube =
      "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\n"
      "GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\n";
  // A wedge as hexahedron: its triangle z = 0 by the diagonal 1, 3 of the four corners.
  const auto wedge = read_deck(cube + "CHEXA,1,1,1,2,3,3,5,6,+\n+,7,7\nPLOAD4,3,1,5.,,,,1,3\n");
  const auto& face = wedge.mesh.surfaces.at("pload4_3").faces.at(0);
  EXPECT_EQ(face.type, mesh::FaceType::kTri3);
  // A left-handed tetrahedron: its face without grid 5, outward.
  const auto tet =
      read_deck(cube.substr(0, cube.find("GRID,6")) + "CTETRA,1,1,1,3,2,5\nPLOAD4,3,1,5.,,,,1,5\n");
  EXPECT_EQ(count_inward(tet.mesh, tet.mesh.surfaces.at("pload4_3")), 0);
}

}  // namespace
}  // namespace clatter::test
