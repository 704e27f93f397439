#pragma once
// Elimination front by front up the tree of supernodes, subtrees on all threads.
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/sparse/factor/front.hpp"
#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// The columns of S A S that are eliminated, by place: lower triangle, boundary rows included.
struct PermutedMatrix {
  std::vector<int64_t> starts;  // n + 1
  std::vector<int32_t> rows;    // places, in no order
  std::vector<double> values;
};

/// @param lower n x n, lower triangle; scale n, the diagonal of S by unknown.
/// @param coupling n x n_b columns that stay, scaled on the left only; or empty.
PermutedMatrix permuted(const SupernodeTree& tree, const SparseMatrix& lower,
                        const std::vector<double>& scale, const SparseMatrix& coupling = {});

/// What to do with an assembled front; supernode s.
using FrontKernel = std::function<void(int32_t s, const Front& front)>;

/// Assembles the fronts from A and the update matrices of the children (Duff and Reid 1983) and
/// hands each to `kernel`, children before parents; update matrices are dropped when assembled.
/// Disjoint subtrees run side by side with one BLAS thread each, the top of the tree with BLAS on
/// all threads. Every front is summed in the order of the tree, so results do not depend on the
/// schedule.
/// @param panels entries() doubles that keep all panels, or nullptr: panels are scratch.
/// @param schur n_b x n_b, both triangles: receives the sum of the updates that reach the boundary
/// (nullptr without boundary).
/// An exception of `kernel` ends the elimination and is thrown on.
void eliminate(const SupernodeTree& tree, const PermutedMatrix& matrix, const FrontKernel& kernel,
               double* panels, Eigen::MatrixXd* schur);

}  // namespace clatter::sparse
