// SPDX-License-Identifier: GPL-3.0-or-later
// Flat cells make K ill-conditioned: its largest eigenvalue is about that of its worst cell
// (Shewchuk, "What is a good linear finite element?", 2002).
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "core/fe/assemble.hpp"
#include "core/mesh/validity.hpp"
#include "mesh_toml.hpp"
#include "tests/assembly/block_mesh.hpp"

namespace clatter::mesh {
namespace {

/// Ratio of the largest and the smallest eigenvalue of K, held at x = 0, by vector iteration: both
/// within a few per cent.
double condition(const Mesh& mesh) {
  fe::Material steel;
  steel.youngs = 2.1e11;
  steel.poisson = 0.3;
  steel.density = 7850.0;
  const SparseMatrix all = fe::assemble(mesh, {steel}, fe::node_pattern(mesh)).K;
  std::vector<int32_t> index(static_cast<size_t>(all.cols()), -1);
  int32_t n = 0;
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    for (Eigen::Index d = 0; mesh.nodes(a, 0) > 1e-9 && d < 3; ++d) index[3 * a + d] = n++;
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  for (Eigen::Index c = 0; c < all.cols(); ++c)
    for (SparseMatrix::InnerIterator it(all, c); it; ++it) {
      const int32_t i = index[it.row()], j = index[c];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, it.value());
    }
  SparseMatrix K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> factor(K);
  EXPECT_EQ(factor.info(), Eigen::Success);
  Eigen::VectorXd stiff = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0), soft = stiff;
  double largest = 0.0, smallest = 0.0;
  for (int step = 0; step < 200; ++step) {
    stiff = multiply_symmetric(K, stiff.normalized());
    largest = stiff.norm();
    soft = factor.solve(soft.normalized());
    smallest = 1.0 / soft.norm();
  }
  return largest / smallest;
}

bool all_positive(const Mesh& mesh) {
  for (Eigen::Index c = 0; c < mesh.cells[0].nodes.rows(); ++c)
    if (!(jacobian_bounds(CellType::kTet10, cell_nodes(mesh, mesh.cells[0], c)).min > 0.0))
      return false;
  return true;
}

void straighten_all(Mesh& mesh) {
  for (const auto& cell : mesh.cells[0].nodes.rowwise())
    for (size_t e = 0; e < 6; ++e)
      mesh.nodes.row(cell(4 + static_cast<Eigen::Index>(e))) =
          0.5 * (mesh.nodes.row(cell(kTetEdges[e][0])) + mesh.nodes.row(cell(kTetEdges[e][1])));
}

/// Moves an inner corner toward the opposite face of a cell until that has a thousandth of its
/// height; the first corner that inverts no other cell.
void flatten_one(Mesh& mesh) {
  std::vector<bool> outer(static_cast<size_t>(mesh.nodes.rows()), false);
  for (const int32_t node : nodes_of(mesh.surface("skin"))) outer[node] = true;
  const RowMatrix before = mesh.nodes;
  for (const auto& cell : mesh.cells[0].nodes.rowwise())
    for (int top = 0; top < 4; ++top) {
      const int32_t node = cell(top);
      if (outer[node]) continue;
      Eigen::RowVector3d foot = Eigen::RowVector3d::Zero();
      for (int i = 0; i < 4; ++i)
        if (i != top) foot += before.row(cell(i)) / 3.0;
      mesh.nodes.row(node) = foot + 1e-3 * (before.row(node) - foot);
      straighten_all(mesh);
      if (all_positive(mesh)) return;
      mesh.nodes = before;
    }
  FAIL() << "no cell could be flattened";
}

constexpr const char* kBar =
    "name = 'bar'\nkind = 'box'\n[box]\nsize = [60, 20, 20]\n[mesh]\nelement_size_mm = 10\n";

TEST(Condition, HardG8_OfAMeshedBarIsThatOfARegularOneAndASliverSpoilsIt) {
  Mesh bar = testing::mesh_toml(kBar).part.mesh;
  const double meshed = condition(bar);
  const double regular = condition(
      assembly::testing::block_mesh({6, 2, 2}, assembly::testing::brick({0.06, 0.02, 0.02})));
  // Cells are about as large; gmsh's smallest have half the size and a third of the angle: 5.
  EXPECT_LT(meshed, 10.0 * regular);

  flatten_one(bar);
  const double spoiled = condition(bar);
  EXPECT_GT(spoiled, 10.0 * meshed);
}

}  // namespace
}  // namespace clatter::mesh
