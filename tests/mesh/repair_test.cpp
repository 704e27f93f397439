// SPDX-License-Identifier: GPL-3.0-or-later
// What lifts slivers and unfolds curved cells, on meshes that can be drawn by hand.
#include <gtest/gtest.h>

#include "mesh/cad/skin_crossing.hpp"
#include "mesh/repair/quality.hpp"
#include "mesh/repair/sliver.hpp"
#include "mesh/repair/straighten.hpp"
#include "mesh/repair/unfold.hpp"
#include "support.hpp"

namespace clatter::mesh {
namespace {

double smallest_angle(const Mesh& mesh) { return measure_quality(mesh).min_dihedral_deg.worst; }

// A flat cell (0 1 2 3) with diagonals 0-2 and 1-3 of a unit square, capped from above (4) and
// below (5): the sliver and four good cells; no node is free.
Mesh square_sliver() {
  Mesh mesh;
  mesh.nodes.resize(6, 3);
  mesh.nodes << 0, 0, -0.005, 1, 0, 0.005, 1, 1, -0.005, 0, 1, 0.005, 0.5, 0.5, 0.8, 0.5, 0.5, -0.8;
  mesh.regions = {"solid"};
  CellBlock block;
  block.type = CellType::kTet4;
  block.nodes.resize(5, 4);
  block.nodes << 0, 1, 2, 3, 0, 1, 3, 4, 1, 2, 3, 4, 0, 2, 1, 5, 0, 3, 2, 5;
  mesh.cells = {block};
  return mesh;
}

TEST(Sliver, SquareSliverVanishesByOneNodeOnItsCrossingDiagonals) {
  Mesh mesh = square_sliver();
  const double volume = cell_volume(mesh);
  ASSERT_LT(smallest_angle(mesh), 2.0);
  const SliverReport report = lift_slivers(mesh, 20.0);
  EXPECT_EQ(report.before, 1);
  EXPECT_EQ(report.after, 0);
  EXPECT_EQ(report.new_nodes, 1);
  EXPECT_EQ(mesh.cell_count(), 8);  // the sliver removed, four cells halved
  EXPECT_GT(smallest_angle(mesh), 20.0);
  EXPECT_NEAR(cell_volume(mesh), volume, 1e-14);  // the boundary stayed: rounding only
  EXPECT_NO_THROW(boundary_faces(mesh));
}

TEST(Sliver, GoodMeshIsLeftAlone) {
  Mesh mesh = square_sliver();
  lift_slivers(mesh, 20.0);
  const RowMatrix before = mesh.nodes;
  EXPECT_EQ(lift_slivers(mesh, 20.0).before, 0);
  EXPECT_EQ(mesh.nodes, before);
}

// Two cells share the face 1 2 3; the middle of edge 0-1 lies on the boundary and is pushed in.
TEST(Unfold, BoundaryStaysAndFreeNodesAloneMove) {
  Mesh mesh = testing::one_cell();
  const RowMatrix before = mesh.nodes;
  mesh.nodes(4, 0) = 0.2;
  EXPECT_EQ(unfold_cells(mesh, 0.1), 1);  // found, but a cell of boundary nodes cannot be helped
  EXPECT_EQ(mesh.nodes(4, 0), 0.2);
  EXPECT_EQ(mesh.nodes.row(9), before.row(9));
  EXPECT_EQ(check_validity(mesh).invalid.size(), 1u);
}

// The same node slides along its edge, which is a curve of the geometry, to where the cell is good.
TEST(Unfold, NodesOfTheBoundarySlideAlongTheGeometryWhereTheyMay) {
  Mesh mesh = testing::one_cell();
  const RowMatrix before = mesh.nodes;
  mesh.nodes(4, 0) = 0.2;
  const Sliding sliding{{4}, [](int32_t node, const Eigen::Vector3d& x) {
                          EXPECT_EQ(node, 4);
                          return Eigen::Vector3d(x.x(), 0.0, 0.0);
                        }};
  EXPECT_EQ(unfold_cells(mesh, 0.1, sliding), 1);
  EXPECT_TRUE(check_validity(mesh).invalid.empty());
  EXPECT_NE(mesh.nodes(4, 0), 0.2);
  EXPECT_EQ(mesh.nodes.row(4).tail<2>().norm(), 0.0);
  for (int node = 0; node < 10; ++node)
    EXPECT_TRUE(node == 4 || mesh.nodes.row(node) == before.row(node)) << node;
}

// The middle of edge 0-1 pushed in by half the edge: with a bow of 1/4 of it left, 1 - 4 x 0.125
// (the derivative of the edge's map at corner 0) stays positive.
TEST(Straighten, HalvesTheBowUntilTheCellIsValidAndTellsHowFar) {
  Mesh mesh = testing::one_cell();
  mesh.nodes(4, 0) -= 0.5;
  ASSERT_EQ(check_validity(mesh).invalid.size(), 1u);
  const std::vector<PulledNode> pulled = straighten_cells(mesh, 0.05);
  EXPECT_TRUE(check_validity(mesh).invalid.empty());
  ASSERT_EQ(pulled.size(), 1u);  // the other edges are straight: nothing to pull
  EXPECT_EQ(pulled[0].node, 4);
  EXPECT_EQ(pulled[0].edge, 1.0);
  EXPECT_EQ(pulled[0].distance, 0.375);
  EXPECT_EQ(mesh.nodes(4, 0), 0.375);
}

TEST(Straighten, ValidCellsKeepTheirBow) {
  Mesh mesh = testing::one_cell();
  mesh.nodes(4, 2) -= 0.05;
  const RowMatrix before = mesh.nodes;
  EXPECT_TRUE(straighten_cells(mesh, 0.05).empty());
  EXPECT_EQ(mesh.nodes, before);
}

// An octahedron, flat at its top edges: cell 0 has two faces on the boundary with a blunt angle at
// the edge between them, and its opposite edge, the axis 4-5, is inside.
TEST(Sliver, ACellWithTwoFacesInOneRoundFaceIsDivided) {
  Mesh mesh;
  mesh.nodes.resize(6, 3);
  mesh.nodes << 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 0.5, 0, 0, -0.5;
  mesh.regions = {"solid"};
  CellBlock block;
  block.type = CellType::kTet4;
  block.nodes.resize(4, 4);
  block.nodes << 4, 5, 1, 0, 4, 5, 2, 1, 4, 5, 3, 2, 4, 5, 0, 3;
  mesh.cells = {block};
  const double volume = cell_volume(mesh);
  ASSERT_GT(volume, 0.0);
  EXPECT_EQ(split_blunt_corners(mesh, 89.0), 0);  // the new cells would have sharper angles
  EXPECT_EQ(split_blunt_corners(mesh, 8.0), 0);   // 70.5 degrees at the equator: not blunt
  mesh.nodes.col(2) *= 3.0;
  EXPECT_EQ(split_blunt_corners(mesh, 8.0), 1);  // one node on the axis serves all four cells
  EXPECT_EQ(mesh.cell_count(), 8);
  EXPECT_NEAR(cell_volume(mesh), 3.0 * volume, 1e-15);
}

// Face 1 lies in z = 0; an edge of face 2 pierces it, face 3 is next to it.
TEST(SkinCrossing, NamesTheFacesAndThePosition) {
  RowMatrix nodes(9, 3);
  nodes << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 9, 9, 1, 3, 3, -1, 3, 3, 1, 9, 9, 2;
  std::map<int, IndexMatrix> triangles;
  for (int face : {1, 2, 3}) triangles[face].resize(1, 3);
  triangles[1] << 0, 1, 2;
  triangles[2] << 3, 4, 5;
  triangles[3] << 6, 7, 8;
  const auto found = find_crossings(nodes, triangles);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].face, 1);
  EXPECT_EQ(found[0].other, 2);
  EXPECT_EQ(found[0].position, Eigen::Vector3d(1, 1, 0));
  triangles.erase(2);
  EXPECT_TRUE(find_crossings(nodes, triangles).empty());
}

}  // namespace
}  // namespace clatter::mesh
