// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a mesh by METIS: hard cases M1 to M5.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "mesh/part/metis_partition.hpp"
#include "tests/observed.hpp"
#include "tests/plain_faults.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

/// n x n x n cubes; `type` kHex8.
Mesh cubes(int n, double shift = 0.0) {
  Mesh mesh;
  mesh.name = "cubes";
  mesh.regions = {"body"};
  const int side = n + 1;
  mesh.nodes.resize(side * side * side, 3);
  const auto node = [&](int i, int j, int k) { return (i * side + j) * side + k; };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      for (int k = 0; k < side; ++k) mesh.nodes.row(node(i, j, k)) << i + shift, j, k;
  CellBlock block{CellType::kHex8, 0, IndexMatrix(n * n * n, 8), {}};
  Eigen::Index row = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
        block.nodes.row(row++) << node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
            node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
            node(i, j + 1, k + 1);
  mesh.cells = {block};
  return mesh;
}

std::string partition_refusal(const Mesh& mesh, int parts) {
  try {
    partition_cells(mesh, parts);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HardM1, QuadraticTetrahedraThatShareAnEdgeAreNoNeighbours) {
  // Two tet10 with the edge 0-1 in common: three shared nodes with the mid-side node, no face.
  Mesh mesh;
  mesh.nodes = RowMatrix::Zero(17, 3);
  mesh.regions = {"body"};
  CellBlock block{CellType::kTet10, 0, IndexMatrix(2, 10), {}};
  block.nodes << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,  //
      0, 1, 10, 11, 4, 12, 13, 14, 15, 16;
  mesh.cells = {block};
  EXPECT_TRUE(cell_neighbours(mesh).neighbour.empty());
  EXPECT_EQ(cell_neighbours(mesh).bodies(), (std::vector<int32_t>{0, 1}));
  EXPECT_NE(partition_refusal(mesh, 2).find("found 2 bodies"), std::string::npos);
  test::observed("refused: " + partition_refusal(mesh, 2));
}

TEST(HardM1, CubesOfASmallMeshAreSeparated) {
  Mesh mesh = cubes(2);
  const Partition two = partition_cells(mesh, 2);
  EXPECT_EQ(std::count(two.part.begin(), two.part.end(), 0), 4);
  EXPECT_EQ(two.cut, 4);  // half of 2 x 2 x 2 cubes: one layer of four faces
}

TEST(HardM2, OnePartIsTheEntireMeshAndMetisIsNotCalled) {
  const Partition one = partition_cells(cubes(2), 1);
  EXPECT_EQ(one.part, std::vector<int32_t>(8, 0));
  EXPECT_EQ(one.cut, 0);
  test::expect_at_most("faces cut by one part", static_cast<double>(one.cut), 0.0);
}

TEST(HardM3, EveryPartHasCellsAndIsConnected) {
  const Mesh mesh = cubes(6);
  const CellNeighbours graph = cell_neighbours(mesh);
  for (const int parts : {2, 3, 7, 16}) {
    const Partition p = partition_cells(mesh, parts);
    std::map<int32_t, int> sizes;
    for (const int32_t part : p.part) ++sizes[part];
    ASSERT_EQ(sizes.size(), static_cast<size_t>(parts));
    int largest = 0;
    for (const auto& [part, size] : sizes) {
      // METIS allows 3 % over the mean; contiguous parts of few cells need a cell or two more.
      EXPECT_LE(size, 1.03 * 216.0 / parts + 2.0);
      largest = std::max(largest, size);
    }
    test::expect_at_most(fmt::format("cells of the largest of {} parts", parts), largest,
                         1.03 * 216.0 / parts + 2.0);
    EXPECT_EQ(p.part, partition_cells(mesh, parts).part);  // the same on every run
  }
  EXPECT_EQ(graph.neighbour.size(), 2u * 3u * 6u * 6u * 5u);
}

TEST(HardM3, HolesInTheNumberingOfNodesDoNotMatter) {
  Mesh mesh = cubes(3);
  const Partition plain = partition_cells(mesh, 3);
  RowMatrix wide = RowMatrix::Zero(2 * mesh.nodes.rows(), 3);
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n) wide.row(2 * n) = mesh.nodes.row(n);
  mesh.nodes = wide;
  mesh.cells[0].nodes *= 2;
  EXPECT_EQ(partition_cells(mesh, 3).part, plain.part);
}

TEST(HardM3, TooManyPartsAreRefused) {
  EXPECT_NE(partition_refusal(cubes(2), 9).find("found 9 parts, expected 1 to 8"),
            std::string::npos);
  EXPECT_NE(partition_refusal(cubes(2), 0).find("expected 1 to 8"), std::string::npos);
  // As many parts as cells: each cell alone, or an error, never an empty part.
  try {
    const Partition all = partition_cells(cubes(2), 8);
    std::vector<int32_t> sorted = all.part;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, (std::vector<int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("is empty"), std::string::npos);
  }
}

TEST(HardM4, MetisThatDiesIsAnErrorHere) {
  // A graph whose neighbours are far outside: METIS reads invalid memory, in the child.
  CellNeighbours broken;
  broken.start = {0, 1, 2};
  broken.neighbour = {2000000000, -2000000000};
  const test::PlainFaults plain;
  const std::string said = test::refusal_of<NumericsError>([&] { metis_parts(broken, 2); });
  test::expect_parts(said, {"partition: METIS ended with signal 11"});
  test::observed("refused: " + said);
}

TEST(HardM5, NodeNumbersFromOneAreRefusedByTheValidator) {
  Mesh mesh = cubes(2);
  mesh.surfaces["skin"];
  mesh.cells[0].nodes.array() += 1;
  try {
    check_structure(mesh, "one-based");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("found node 27, expected 0 to 26"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace clatter::mesh
