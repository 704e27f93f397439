// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Supernodes of a sparse factor by CHOLMOD's symbolic analysis.
#include <vector>

#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// Fills order, first, row_start and rows of `tree` for L of P A P^T (Chen, Davis, Hager and
/// Rajamanickam 2008), in postorder.
/// Throws NumericsError when memory runs out.
/// @param lower n x n, lower triangle; order: permutation, n.
/// @param merged supernodes are merged where this adds few zeros; else L has no stored zeros.
void find_supernodes(const SparseMatrix& lower, const std::vector<int64_t>& order, bool merged,
                     SupernodeTree& tree);

}  // namespace clatter::sparse
