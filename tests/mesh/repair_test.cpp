// What lifts slivers and unfolds curved cells, on meshes that can be drawn by hand.
#include <gtest/gtest.h>

#include "mesh/quality.hpp"
#include "mesh/sliver.hpp"
#include "mesh/unfold.hpp"
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
  EXPECT_EQ(mesh.cell_count(), 8);  // the sliver gone, four cells halved
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

}  // namespace
}  // namespace clatter::mesh
