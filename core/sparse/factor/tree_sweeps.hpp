#pragma once
// Triangular solves on all threads: subtrees side by side, then the top by right-hand sides.
#include <cstdint>
#include <memory>
#include <vector>

#include "core/sparse/factor/sweeps.hpp"
#include "core/sparse/factor/tree_schedule.hpp"

namespace clatter::sparse {

/// Below the top each thread has subtrees of its own, so that all threads together read L once;
/// what they take from the top's rows is summed per thread and added in their order: the same bits
/// on every run with one thread count.
class TreeSweeps {
 public:
  TreeSweeps() = default;
  TreeSweeps(const SupernodeTree& tree, int threads);

  /// x <- S L^{-T} L^{-1} S x for `count` values of each place, 1 or a multiple of kLanes.
  /// @param scale S by unknown.
  void solve(const FactorView& L, const std::vector<double>& scale, double* x, int count) const;
  /// x <- L^{-1} S x for the unknowns; x also has the places of the boundary and takes -L_b L^{-1}
  /// S x there.
  void forward_to_boundary(const FactorView& L, const std::vector<double>& scale, double* x,
                           int count) const;

 private:
  struct Task;
  std::unique_ptr<double[]> room_for_sums(int count) const;
  void forward_subtrees(const Task& task) const;
  void join_top(const Task& task) const;
  void sweep_top(const Task& task, bool back) const;
  void backward_subtrees(const Task& task) const;

  std::vector<std::vector<int32_t>> shares_;  // roots of the subtrees of each thread
  std::vector<int32_t> lowest_, top_;         // as in TreeSchedule
  std::vector<int32_t> top_places_;           // of the top's unknowns and of the boundary
  std::vector<int32_t> index_;                // of a place among top_places_
};

}  // namespace clatter::sparse
