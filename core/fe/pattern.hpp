#pragma once
// Which nodes share a cell, hence where M and K have entries.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// Lower triangle of the node adjacency, column by column: rows[start[j]] = j itself, then the
/// nodes above j that share a cell with it, ascending.
struct NodePattern {
  std::vector<int64_t> start;  // n_nodes + 1
  std::vector<int32_t> rows;

  int64_t nodes() const { return static_cast<int64_t>(start.size()) - 1; }
  /// Position of row `node` within column `column`, counted from start[column]; it must be there.
  int64_t position(int32_t column, int32_t node) const;
};

/// Entries of the lower triangles, predicted before any memory is taken.
struct PredictedSize {
  int64_t dofs;        // 3 n_nodes
  int64_t stiffness;   // entries of K
  int64_t mass;        // entries of M: M couples no directions
  double gib() const;  // of both matrices together
};

/// Sizes for `nodes` nodes and `pairs` pairs of different nodes that share a cell. InputError when
/// K would not fit 32-bit indices (hard case E4).
PredictedSize predict_size(int64_t nodes, int64_t pairs);

/// Adjacency of all cells. Each node collects its neighbours from its own cells: no list of
/// entries with repetitions is held.
NodePattern node_pattern(const mesh::Mesh& mesh);

}  // namespace clatter::fe
