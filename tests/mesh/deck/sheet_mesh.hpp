// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A cube of one cell and, beside it, a sheet with a rib, for the writers.
#include <gtest/gtest.h>

#include "core/mesh/boundary.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::mesh::testing {

inline ShellBlock shells_of(FaceType type, int32_t region, const std::vector<int32_t>& nodes,
                            int32_t id) {
  ShellBlock block;
  block.type = type;
  block.region = region;
  block.nodes =
      Eigen::Map<const IndexMatrix>(nodes.data(), 1, static_cast<Eigen::Index>(nodes.size()));
  block.ids = {id};
  return block;
}

/// Regions "block" (a hex8), "sheet" (a tri3 and a quad4), "rib" (a quad4 with its own thickness
/// and offset), numbers that do not ascend, and the surface "wet": a face of the cube, the outward
/// side of the triangle, the other one of the quadrilateral of the sheet.
inline Mesh cube_and_sheet() {
  Mesh mesh;
  mesh.name = "cube and sheet";
  mesh.nodes.resize(15, 3);
  mesh.nodes << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,  // cube
      0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1, 2, 2, 0.5, 2, 1, 0, 1.5, 1, 1, 1.5;
  for (int32_t n = 0; n < 15; ++n) mesh.node_ids.push_back(100 - 3 * n);
  mesh.regions = {"block", "sheet", "rib"};
  CellBlock cube;
  cube.type = CellType::kHex8;
  cube.ids = {9};
  cube.nodes.resize(1, 8);
  cube.nodes << 0, 1, 2, 3, 4, 5, 6, 7;
  mesh.cells = {cube};
  mesh.shells = {shells_of(FaceType::kTri3, 1, {9, 12, 10}, 71),
                 shells_of(FaceType::kQuad4, 1, {8, 9, 10, 11}, 70),
                 shells_of(FaceType::kQuad4, 2, {9, 10, 14, 13}, 5)};
  mesh.shells[2].thickness.resize(1, 4);
  mesh.shells[2].thickness << 0.001, 0.001, 0.0025, 0.00225;
  mesh.shells[2].offset = Eigen::VectorXd::Constant(1, -0.00125);
  mesh.node_sets["edge"] = {8, 11};
  mesh.surfaces["skin"] = skin_of(boundary_faces(mesh), mesh.shells);
  SurfaceBuilder wet;
  wet.add(FaceType::kQuad4, std::array{4, 5, 6, 7});
  wet.add(FaceType::kTri3, std::array{9, 12, 10});
  wet.add(FaceType::kQuad4, std::array{8, 11, 10, 9});
  mesh.surfaces["wet"] = wet.finish();
  return mesh;
}

inline void expect_same_shells(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.shells.size(), b.shells.size());
  for (size_t i = 0; i < a.shells.size(); ++i) {
    EXPECT_EQ(a.shells[i].type, b.shells[i].type);
    EXPECT_EQ(a.shells[i].region, b.shells[i].region);
    EXPECT_EQ(a.shells[i].nodes, b.shells[i].nodes);
    EXPECT_EQ(a.shells[i].ids, b.shells[i].ids);
    EXPECT_EQ(a.shells[i].thickness, b.shells[i].thickness);
    EXPECT_EQ(a.shells[i].offset, b.shells[i].offset);
  }
}

}  // namespace clatter::mesh::testing
