// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Fill-reducing permutations, which determine fill, memory and time.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// Permutation methods; kNatural keeps the order of the matrix (tests and given permutations).
enum class Ordering { kMetis, kAmd, kNatural };

/// METIS uses 32-bit indices (hard case C5): kMetis is replaced by kAmd when a graph with `edges`
/// entries and `size` vertices does not fit.
Ordering safe_ordering(Ordering wanted, int64_t size, int64_t edges);

/// Merges unknowns that have the same neighbours and are adjacent (the displacements of a node):
/// METIS orders one vertex for all of them, weighted by their number (Ashcraft, Compressed graphs
/// and the minimum degree algorithm, 1995).
struct CompressedGraph {
  std::vector<int32_t> vertex;  // of each unknown
  std::vector<int32_t> weight;  // unknowns of each vertex
  std::vector<int64_t> starts;  // into neighbours, vertices + 1
  std::vector<int32_t> neighbours;
  int32_t size() const { return static_cast<int32_t>(weight.size()); }
};

/// Builds the compressed graph.
/// @param lower n x n, lower triangle.
CompressedGraph compress_graph(const SparseMatrix& lower);

struct FillOrder {
  std::vector<int32_t> order;  // permutation: unknown at each index
  Ordering method = Ordering::kNatural;
};

/// Nested dissection by METIS (Karypis and Kumar 1998) on the compressed graph, always from the
/// same seed; AMD (Amestoy, Davis and Duff 2004) where METIS's indices overflow or memory runs out
/// (hard cases C5, C6).
FillOrder fill_reducing_order(const SparseMatrix& lower, Ordering wanted);

/// "metis", "amd", "natural".
std::string ordering_name(Ordering ordering);

}  // namespace clatter::sparse
