// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic cells whose mid-side nodes follow the ends of their edges.
#include <gtest/gtest.h>

#include <numeric>

#include "assembly/model/build.hpp"
#include "core/base/error.hpp"
#include "core/dense/least_squares.hpp"
#include "core/mesh/boundary.hpp"
#include "one_cell.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellType;

constexpr const char* kStraight = "[[straight_edges]]\nnode_set = \"hanging_mid_side_nodes\"\n";

mesh::Mesh one_cell(CellType type) {
  mesh::Mesh mesh;
  mesh.name = "one";
  mesh.regions = {"solid"};
  mesh.nodes = mesh::reference_nodes(type);
  mesh::CellBlock block;
  block.type = type;
  block.nodes.resize(1, mesh.nodes.rows());
  std::iota(block.nodes.data(), block.nodes.data() + block.nodes.size(), 0);
  mesh.cells.push_back(block);
  return mesh;
}

/// A cube (hex8) under a pyramid13 without mid-side nodes on its base.
mesh::Mesh cube_under_pyramid() {
  mesh::Mesh mesh = one_cell(CellType::kPyramid13);
  const Eigen::Index first = mesh.nodes.rows();
  mesh.nodes.conservativeResize(first + 4, 3);
  mesh::CellBlock cube;
  cube.type = CellType::kHex8;
  cube.nodes.resize(1, 8);
  for (int i = 0; i < 4; ++i) {
    mesh.nodes.row(first + i) = mesh.nodes.row(i) - Eigen::RowVector3d(0.0, 0.0, 2.0);
    cube.nodes(0, i) = static_cast<int32_t>(first) + i;
    cube.nodes(0, 4 + i) = i;
  }
  mesh.cells.push_back(cube);
  const mesh::CellTraits& pyramid = mesh::traits(CellType::kPyramid13);
  for (int e = 0; e < 8; ++e)
    if (pyramid.edges[e][0] < 4 && pyramid.edges[e][1] < 4)
      mesh.node_sets[mesh::kHangingMidSideNodes].push_back(5 + e);
  mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh));
  return mesh;
}

class StraightEdges : public ::testing::TestWithParam<std::pair<CellType, CellType>> {};

TEST_P(StraightEdges, OfAllEdgesMakeTheLinearCell) {
  const auto [linear, quadratic] = GetParam();
  const mesh::Mesh corners = one_cell(linear);
  mesh::Mesh whole = one_cell(quadratic);
  for (auto n = static_cast<int32_t>(corners.nodes.rows()); n < whole.nodes.rows(); ++n)
    whole.node_sets[mesh::kHangingMidSideNodes].push_back(n);
  whole.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(whole));
  const fe::FeModel model = build(whole, kStraight).model;
  const fe::NodalMatrices want = fe::assemble(corners,
                                              materials_of(corners,
                                                           [] {
                                                             fe::Material full = kSteel;
                                                             full.integration.hex8 =
                                                                 fe::Integration::kFull;
                                                             return full;
                                                           }()),
                                              fe::node_pattern(corners));
  // Rounding; both rules integrate these cells exactly.
  EXPECT_LT((full(model.K) - full(want.K)).cwiseAbs().maxCoeff(), 1e-12 * full(want.K).maxCoeff());
  EXPECT_LT((full(model.M) - full(want.M)).cwiseAbs().maxCoeff(), 1e-12 * full(want.M).maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Cells, StraightEdges,
                         ::testing::Values(std::pair(CellType::kTet4, CellType::kTet10),
                                           std::pair(CellType::kHex8, CellType::kHex20),
                                           std::pair(CellType::kWedge6, CellType::kWedge15),
                                           std::pair(CellType::kPyramid5, CellType::kPyramid13)));

TEST(StraightEdgesOfAMesh, JoinAQuadraticCellToALinearOne) {
  const mesh::Mesh mesh = cube_under_pyramid();
  EXPECT_EQ(mesh.surface("skin").face_count(), 5 + 4);  // the common face is inside
  const fe::FeModel model = build(mesh, kStraight).model;
  EXPECT_EQ(model.size(), 3 * (mesh.nodes.rows() - 4));
  // A stretch along x: its energy is E / 2 (1 - nu) / ((1 + nu) (1 - 2 nu)) times the volume.
  const Eigen::MatrixXd T = model.T;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(T.rows());
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) u(3 * n) = 1e-3 * mesh.nodes(n, 0);
  const Eigen::VectorXd q = dense::least_squares(T, u).X;
  EXPECT_LT((T * q - u).norm(), 1e-15);
  const double volume = 8.0 + 4.0 / 3.0;
  const double want = 0.5 * 1e-6 * volume * (kSteel.lambda() + 2.0 * kSteel.mu());
  EXPECT_NEAR(0.5 * q.dot(full(model.K) * q), want, 1e-12 * want);
}

TEST(StraightEdgesOfAMesh, AreNotForgotten) {
  mesh::Mesh mesh = cube_under_pyramid();
  test::expect_parts(
      test::refusal_of([&] { build(mesh, ""); }),
      {"test.fe.toml",
       "straight_edges: found none, the mesh has the node set \"hanging_mid_side_nodes\"",
       "expected [[straight_edges]] with node_set = \"hanging_mid_side_nodes\""});
  mesh.node_sets[mesh::kHangingMidSideNodes] = {0};  // a corner
  test::expect_parts(test::refusal_of([&] { build(mesh, kStraight); }),
                     {"straight edges hanging_mid_side_nodes: node 0 is not a mid-side node"});
}

TEST(StraightEdgesOfAMesh, AreWhatLetsALinearFaceMeetAQuadraticOne) {
  mesh::Mesh mesh = cube_under_pyramid();
  mesh.node_sets.clear();
  test::expect_parts(test::refusal_of([&] { mesh::boundary_faces(mesh); }),
                     {"mesh 'one': ", "(pyramid13)", "(hex8)", "share the face with corners",
                      "but not its mid-side nodes, expected the same nodes on both sides"});
}

}  // namespace
}  // namespace clatter::assembly::testing
