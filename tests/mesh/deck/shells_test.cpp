// SPDX-License-Identifier: GPL-3.0-or-later
// What both readers do with shells: their side, their parts, which faces are shells.
#include <gmock/gmock.h>

#include "core/mesh/orient_shells.hpp"
#include "mesh/deck/shell_shape.hpp"

namespace clatter::mesh::deck {
namespace {

using ::testing::HasSubstr;

ShellBlock block(FaceType type, std::vector<std::vector<int32_t>> cells) {
  ShellBlock out;
  out.type = type;
  out.nodes.resize(std::ssize(cells), traits(type).nodes);
  for (size_t c = 0; c < cells.size(); ++c)
    for (size_t i = 0; i < cells[c].size(); ++i)
      out.nodes(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(i)) = cells[c][i];
  return out;
}

std::vector<int32_t> row(const ShellBlock& block, Eigen::Index cell) {
  const auto nodes = block.nodes.row(cell);
  return {nodes.begin(), nodes.end()};
}

// 0 1 2 3
// 4 5 6 7
TEST(OrientShells, TheFewerOnesAreTurnedWithThicknessAndOffset) {
  std::vector<ShellBlock> shells = {
      block(FaceType::kQuad4, {{0, 4, 5, 1}, {1, 2, 6, 5}, {2, 6, 7, 3}})};
  shells[0].thickness.resize(3, 4);
  shells[0].thickness.setOnes();
  shells[0].thickness.row(1) << 1, 2, 3, 4;
  shells[0].offset = Eigen::Vector3d(0.5, 0.25, 0.5);
  EXPECT_EQ(orient_shells(shells), 1);
  EXPECT_EQ(row(shells[0], 0), (std::vector<int32_t>{0, 4, 5, 1}));
  EXPECT_EQ(row(shells[0], 1), (std::vector<int32_t>{1, 5, 6, 2}));
  EXPECT_EQ(shells[0].thickness.row(1), Eigen::RowVector4d(1, 4, 3, 2));
  EXPECT_EQ(shells[0].offset(1), -0.25);
  EXPECT_EQ(orient_shells(shells), 0);
}

TEST(OrientShells, NeighboursOfOtherBlocksAgreeToo) {
  std::vector<ShellBlock> shells = {block(FaceType::kQuad4, {{0, 4, 5, 1}, {4, 8, 9, 5}}),
                                    block(FaceType::kTri3, {{1, 2, 5}})};
  EXPECT_EQ(orient_shells(shells), 1);
  EXPECT_EQ(row(shells[1], 0), (std::vector<int32_t>{1, 5, 2}));
}

TEST(OrientShells, AnEdgeOfThreeShellsDividesThem) {
  std::vector<ShellBlock> shells = {block(FaceType::kTri3, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})};
  EXPECT_EQ(orient_shells(shells), 0);
}

TEST(OrientShells, AMoebiusStripKeepsItsSides) {
  // Nodes 0, 2, 4 on one border, 1, 3, 5 on the other; the last cell joins them crosswise.
  std::vector<ShellBlock> shells = {
      block(FaceType::kQuad4, {{0, 1, 3, 2}, {2, 3, 5, 4}, {4, 5, 0, 1}})};
  const IndexMatrix before = shells[0].nodes;
  EXPECT_EQ(orient_shells(shells), 0);
  EXPECT_EQ(shells[0].nodes, before);
}

TEST(OrientShells, MidSideNodesTurnWithTheirSides) {
  std::vector<ShellBlock> shells = {
      block(FaceType::kQuad8, {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 12, 11, 5, 15, 14, 13}}),
      block(FaceType::kTri6, {{2, 12, 20, 15, 21, 22}})};
  EXPECT_EQ(orient_shells(shells), 1);  // the one between both others
  EXPECT_EQ(row(shells[0], 0), (std::vector<int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(row(shells[0], 1), (std::vector<int32_t>{1, 11, 12, 2, 13, 14, 15, 5}));
  EXPECT_EQ(row(shells[1], 0), (std::vector<int32_t>{2, 12, 20, 15, 21, 22}));
}

TEST(ShellShape, ConcaveFoldedAndFlatFacesAreNone) {
  RowMatrix x(5, 3);
  x << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.2, 0.2, 0;
  const auto defect = [&](std::array<int32_t, kMaxFaceNodes> nodes, FaceType type) {
    return shape_of({.type = type, .nodes = nodes}, x).defect;
  };
  EXPECT_EQ(defect({0, 1, 2, 3}, FaceType::kQuad4), "");
  EXPECT_THAT(defect({0, 1, 4, 3}, FaceType::kQuad4), HasSubstr("is concave or folded"));
  EXPECT_THAT(defect({0, 1, 3, 2}, FaceType::kQuad4), HasSubstr("has no area"));
  EXPECT_THAT(defect({0, 2, 4}, FaceType::kTri3), HasSubstr("has no area"));
}

TEST(ShellShape, WarpIsTheDistanceOfTheDiagonalsOverTheSize) {
  RowMatrix x(4, 3);
  x << 0, 0, 0.1, 1, 0, -0.1, 1, 1, 0.1, 0, 1, -0.1;
  EXPECT_NEAR(shape_of({.nodes = {0, 1, 2, 3}}, x).warp, 0.2, 1e-14);
}

}  // namespace
}  // namespace clatter::mesh::deck
