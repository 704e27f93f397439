// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sizes of all fronts of a factorisation, from the graph alone.
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// The fronts of L of P A P^T and of the boundary's rows, children before parents. Supernodes are
/// not merged: the counts are exact.
struct FrontSizes {
  std::vector<int64_t> columns;  // eliminated at each front
  std::vector<int64_t> height;   // rows of each front, own columns and boundary included
  std::vector<int32_t> parent;   // -1 for a root
  int64_t size = 0, boundary = 0;
  std::string ordering;  // "metis" or "amd"

  int32_t fronts() const { return static_cast<int32_t>(parent.size()); }
  int64_t below(int32_t s) const { return height[at(s)] - columns[at(s)]; }
  /// Entries of the front's columns of L.
  int64_t entries(int32_t s) const;
  int64_t entries() const;
  /// Multiplications and additions of a Cholesky factorisation: the sum of the squared lengths of
  /// its columns.
  double flops(int32_t s) const;
  double flops() const;

 private:
  static size_t at(int32_t s) { return static_cast<size_t>(s); }
};

/// Orders A as a condensation does and counts: METIS, elimination tree and columns (Gilbert, Ng and
/// Peyton 1994, in CHOLMOD) of the compressed graph, whose vertices are the unknowns of a node; a
/// third of the unknowns and a ninth of the entries. NumericsError when memory runs out.
/// @param lower n x n, pattern of the lower triangle.
/// @param coupling n x n_b, pattern of the columns not eliminated (K_ib), or empty.
FrontSizes count_fronts(const SparseMatrix& lower, const SparseMatrix& coupling = {});

}  // namespace clatter::sparse
