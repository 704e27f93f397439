// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sparsity pattern of M and K: nodes that share a cell.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// Lower triangle of the node adjacency, by columns: rows[start[j]] = j itself, then the nodes
/// above j that share a cell with it, ascending.
struct NodePattern {
  std::vector<int64_t> start;  // n_nodes + 1
  std::vector<int32_t> rows;

  int64_t nodes() const { return static_cast<int64_t>(start.size()) - 1; }
  /// Position of row `node` within column `column`, counted from start[column]; it must be there.
  int64_t position(int32_t column, int32_t node) const;
};

/// Entries of the lower triangles, predicted before memory is allocated.
struct PredictedSize {
  int64_t dofs;        // 3 n_nodes
  int64_t stiffness;   // entries of K
  int64_t mass;        // entries of M: M does not couple directions
  double gib() const;  // of both matrices together
};

/// Sizes for `nodes` nodes and `pairs` pairs of different nodes that share a cell. InputError when
/// K would not fit 32-bit indices (hard case E4).
PredictedSize predict_size(int64_t nodes, int64_t pairs);

/// Adjacency from all cells. Each node collects its neighbours from its own cells; no list of
/// duplicate entries is held.
NodePattern node_pattern(const mesh::Mesh& mesh);

}  // namespace clatter::fe
