// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parallel triangular solves: subtrees in parallel, then the top by right-hand sides.
#include <cstdint>
#include <memory>
#include <vector>

#include "core/sparse/factor/sweeps.hpp"
#include "core/sparse/factor/tree_schedule.hpp"

namespace clatter::sparse {

/// Below the top each thread has its own subtrees, so that all threads together read L once;
/// updates of the top's rows are summed per thread and added in thread order: the same bits on
/// every run with one thread count.
class TreeSweeps {
 public:
  TreeSweeps() = default;
  TreeSweeps(const SupernodeTree& tree, int threads);

  /// x <- S L^{-T} L^{-1} S x for `count` values per row, 1 or a multiple of kLanes.
  /// @param scale S in the order of A.
  void solve(const FactorView& L, const std::vector<double>& scale, double* x, int count) const;
  /// x <- L^{-1} S x for the unknowns; x also has the boundary rows, which receive -L_b L^{-1} S x.
  void forward_to_boundary(const FactorView& L, const std::vector<double>& scale, double* x,
                           int count) const;

 private:
  struct Task;
  std::unique_ptr<double[]> allocate_sums(int count) const;
  void forward_subtrees(const Task& task) const;
  void join_top(const Task& task) const;
  void sweep_top(const Task& task, bool back) const;
  void backward_subtrees(const Task& task) const;

  std::vector<std::vector<int32_t>> shares_;  // roots of the subtrees of each thread
  std::vector<int32_t> lowest_, top_;         // as in TreeSchedule
  std::vector<int32_t> top_indices_;          // of the top's unknowns and of the boundary
  std::vector<int32_t> index_;                // position of a row in top_indices_
};

}  // namespace clatter::sparse
