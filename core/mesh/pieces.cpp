// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace clatter::mesh {
namespace {

constexpr double kSamePosition = 1e-9;  // of the diagonal of the mesh's box

/// The first node of each node's piece, -1 for nodes without cells.
std::vector<int32_t> roots_of(const Mesh& mesh) {
  std::vector<int32_t> above(static_cast<size_t>(mesh.nodes.rows()));
  std::iota(above.begin(), above.end(), 0);
  const auto root = [&](int32_t node) {
    while (above[node] != node) {
      int32_t& next = above[node];
      next = above[next];
      node = next;
    }
    return node;
  };
  std::vector<char> used(above.size(), 0);
  const auto join = [&](const IndexMatrix& cells) {
    for (const auto& cell : cells.rowwise())
      for (const int32_t node : cell) {
        used[node] = 1;
        const int32_t a = root(cell[0]), b = root(node);
        above[std::max(a, b)] = std::min(a, b);
      }
  };
  for (const CellBlock& block : mesh.cells) join(block.nodes);
  for (const ShellBlock& block : mesh.shells) join(block.nodes);
  for (size_t node = 0; node < above.size(); ++node)
    above[node] = used[node] ? root(static_cast<int32_t>(node)) : -1;
  return above;
}

int64_t count_coincident(const Mesh& mesh, const std::vector<int32_t>& roots) {
  const Eigen::RowVector3d size = mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff();
  const double near = kSamePosition * size.norm();
  // Sorted along a direction in which hardly two nodes of a regular mesh coincide.
  const Eigen::VectorXd along = mesh.nodes * Eigen::Vector3d(0.5141, 0.6473, 0.5627);
  std::vector<int32_t> order(roots.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) { return along[a] < along[b]; });
  std::vector<char> found(roots.size(), 0);
  for (size_t i = 0; i < order.size(); ++i) {
    const int32_t a = order[i];
    for (size_t k = i + 1; k < order.size() && along[order[k]] - along[a] <= 2.0 * near; ++k) {
      const int32_t b = order[k];
      const int32_t of_a = roots[a], of_b = roots[b];
      if (of_a < 0 || of_b < 0 || of_a == of_b) continue;
      if (!((mesh.nodes.row(a) - mesh.nodes.row(b)).norm() <= near)) continue;
      found[std::max(a, b)] = 1;
    }
  }
  return std::count(found.begin(), found.end(), 1);
}

}  // namespace

Pieces pieces_of(const Mesh& mesh) {
  const std::vector<int32_t> roots = roots_of(mesh);
  Pieces pieces;
  for (size_t node = 0; node < roots.size(); ++node)
    if (roots[node] == static_cast<int32_t>(node)) ++pieces.count;
  if (pieces.count > 1) pieces.coincident_nodes = count_coincident(mesh, roots);
  return pieces;
}

}  // namespace clatter::mesh
