// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Multifrontal elimination along the supernode tree, with parallel subtrees.
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/sparse/factor/front.hpp"
#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// The eliminated columns of S A S, in elimination order: lower triangle with boundary rows.
struct PermutedMatrix {
  std::vector<int64_t> starts;  // n + 1
  std::vector<int32_t> rows;    // in elimination order, unsorted
  std::vector<double> values;
};

/// @param lower n x n, lower triangle; scale n, the diagonal of S in the order of A.
/// @param coupling n x n_b, columns not eliminated, scaled on the left only; or empty.
PermutedMatrix permuted(const SupernodeTree& tree, const SparseMatrix& lower,
                        const std::vector<double>& scale, const SparseMatrix& coupling = {});

/// Eliminates the assembled front of supernode s.
using FrontKernel = std::function<void(int32_t s, const Front& front)>;

/// Assembles the fronts from A and the update matrices of the children (Duff and Reid 1983) and
/// passes each to `kernel`, children before parents; update matrices are freed once assembled.
/// Disjoint subtrees run in parallel with one BLAS thread each, the top of the tree with BLAS on
/// all threads. Every front is summed in tree order, so results do not depend on the schedule.
/// @param panels entries() doubles that receive all panels, or nullptr: panels are temporary.
/// @param schur n_b x n_b, both triangles: receives the sum of the updates of the boundary (nullptr
/// without boundary).
/// An exception of `kernel` ends the elimination and is rethrown.
void eliminate(const SupernodeTree& tree, const PermutedMatrix& matrix, const FrontKernel& kernel,
               double* panels, Eigen::MatrixXd* schur);

}  // namespace clatter::sparse
