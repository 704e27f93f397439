// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes at their limits: far from the origin, cells twice, pieces that touch.
#include <gtest/gtest.h>

#include "core/mesh/boundary.hpp"
#include "core/mesh/pieces.hpp"
#include "mesh/repair/certify_mesh.hpp"
#include "mesh/repair/quality.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using assembly::testing::block_mesh;
using assembly::testing::brick;

constexpr CellType kAll[] = {CellType::kTet4,     CellType::kTet10,    CellType::kHex8,
                             CellType::kHex20,    CellType::kWedge6,   CellType::kWedge15,
                             CellType::kPyramid5, CellType::kPyramid13};

Mesh block(CellType type) {
  return block_mesh({3, 2, 2}, brick({0.3, 0.1, 0.1}), {type, false, false});
}

TEST(HardF2, AMeshFarFromTheOriginIsClosedAndHasItsVolume) {
  for (const CellType type : kAll) {
    Mesh mesh = block(type);
    mesh.nodes.rowwise() += Eigen::RowVector3d(3e5, -1e5, 2e5);  // 1e6 times the length
    const MeshCertificate found = certify_mesh(mesh, measure_quality(mesh));
    // Positions are rounded to 6e-11 m, a tenth of a millionth of a percent of a cell.
    test::expect_at_most(std::string(traits(type).name) + ": volume against the surface",
                         found.volume_against_surface_integral, 1e-10);
    test::expect_at_most("volume against the box", std::abs(found.volume_m3 / 0.003 - 1.0), 1e-8);
  }
}

TEST(HardF4, ACellThatIsThereTwiceIsNamed) {
  for (const CellType type : kAll) {
    Mesh mesh = block(type);
    CellBlock& cells = mesh.cells.back();
    const Eigen::Index n = cells.nodes.rows();
    cells.nodes.conservativeResize(n + 1, Eigen::NoChange);
    cells.nodes.row(n) = cells.nodes.row(n - 1).eval();
    test::expect_parts(test::refusal_of([&] { boundary_faces(mesh); }),
                       {"and cell", "have the same corners, expected each cell once"});
  }
  // Alone, the two share all their faces, none of which would be a boundary.
  Mesh one = block_mesh({1, 1, 1}, brick({1, 1, 1}), {CellType::kHex8, false, false});
  CellBlock& cells = one.cells.front();
  const IndexMatrix once = cells.nodes;
  cells.nodes.resize(2, once.cols());
  cells.nodes << once, once;
  const std::string message = test::refusal_of([&] { boundary_faces(one); });
  test::expect_parts(message, {"have the same corners"});
  test::observed("refused: " + message);
}

TEST(HardF5, PiecesThatTouchAreCountedWithTheirCoincidentNodes) {
  for (const CellType type : kAll) {
    Mesh mesh = block(type);
    EXPECT_EQ(pieces_of(mesh).count, 1);
    EXPECT_EQ(pieces_of(mesh).coincident_nodes, 0);
    const Mesh other = block(type);
    const auto first = static_cast<int32_t>(mesh.nodes.rows());
    mesh.nodes.conservativeResize(2 * first, 3);
    mesh.nodes.bottomRows(first) = other.nodes.rowwise() + Eigen::RowVector3d(0.3, 0.0, 0.0);
    for (CellBlock cells : other.cells) {
      cells.nodes.array() += first;
      mesh.cells.push_back(cells);
    }
    int64_t at_the_joint = 0;
    for (Eigen::Index a = 0; a < first; ++a) at_the_joint += mesh.nodes(a, 0) > 0.3 - 1e-9;
    const Pieces pieces = pieces_of(mesh);
    EXPECT_EQ(pieces.count, 2);
    EXPECT_EQ(pieces.coincident_nodes, at_the_joint);
    mesh.nodes.bottomRows(first).col(0).array() += 1e-6;  // a gap of 1 um
    EXPECT_EQ(pieces_of(mesh).coincident_nodes, 0);
    test::observed(fmt::format("{}: {} pieces, {} nodes on one another", traits(type).name,
                               pieces.count, pieces.coincident_nodes));
  }
}

}  // namespace
}  // namespace clatter::mesh
