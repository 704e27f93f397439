// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Symbolic structure of a sparse factor: supernodes, their rows, and the elimination tree.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/sparse/factor/ordering.hpp"

namespace clatter::sparse {

/// Columns of L with the same rows form a supernode; with these rows it is a front, a dense matrix
/// (Liu, The multifrontal method for sparse matrix solution, 1992). Indices 0 .. n-1 are the
/// unknowns in elimination order; indices n .. n+n_b-1 are boundary unknowns, which are not
/// eliminated.
struct SupernodeTree {
  int32_t size = 0;                // n
  int32_t boundary = 0;            // n_b
  std::vector<int32_t> order;      // permutation: unknown at each of the n indices
  std::vector<int32_t> first;      // columns of supernode s: first[s] .. first[s + 1] - 1
  std::vector<int64_t> row_start;  // rows of s: rows[row_start[s]] .. rows[row_start[s + 1]] - 1
  std::vector<int32_t> rows;       // ascending indices; its own columns come first
  std::vector<int32_t> parent;     // supernode of the first row that is not its own; -1 for a root
  std::vector<int64_t> panel_start;  // offset of the columns of s in the entries of L
  std::string ordering;              // "metis", "amd", "natural", "given"
  double seconds = 0.0;              // spent on ordering and analysis

  int32_t supernodes() const { return static_cast<int32_t>(parent.size()); }
  int32_t columns(int32_t s) const { return first[at(s) + 1] - first[at(s)]; }
  /// Rows of the front, own columns and boundary included.
  int32_t height(int32_t s) const {
    return static_cast<int32_t>(row_start[at(s) + 1] - row_start[at(s)]);
  }
  /// Rows below the own columns, the boundary included.
  int32_t below(int32_t s) const { return height(s) - columns(s); }
  /// Rows below the own columns that are unknowns to eliminate.
  int32_t interior_below(int32_t s) const { return rows_before(s, size); }
  /// Rows below the own columns with index less than `index`.
  int32_t rows_before(int32_t s, int32_t index) const;
  const int32_t* rows_of(int32_t s) const { return rows.data() + row_start[at(s)]; }
  /// Entries of all panels (columns(s) x height(s) each).
  int64_t entries() const { return panel_start.back(); }
  /// Multiplications and additions of a Cholesky factorisation of supernode s.
  double flops(int32_t s) const;
  double flops() const;
  /// Peak number of entries of simultaneous update matrices, one thread.
  int64_t stack_entries() const;
  std::vector<std::vector<int32_t>> children() const;
  /// First supernode of each subtree, which is lowest[s] .. s.
  std::vector<int32_t> lowest() const;
  /// Supernode of each index; index of each unknown (inverse of `order`).
  std::vector<int32_t> owners() const;
  std::vector<int32_t> inverse_order() const;

 private:
  static size_t at(int32_t s) { return static_cast<size_t>(s); }
};

struct TreeOptions {
  Ordering ordering = Ordering::kMetis;
  std::vector<int64_t> permutation;  // used instead of an ordering when not empty
  bool merged = true;                // supernodes are merged where this adds few zeros
};

/// Orders A and finds the supernodes of its factor (CHOLMOD's analysis: Chen, Davis, Hager and
/// Rajamanickam 2008).
/// @param lower n x n, lower triangle.
/// @param coupling n x n_b, pattern of the columns not eliminated (K_ib), or empty.
/// Throws NumericsError when memory runs out or the given permutation is invalid.
SupernodeTree analyse_tree(const SparseMatrix& lower, const TreeOptions& options,
                           const SparseMatrix& coupling = {});

}  // namespace clatter::sparse
