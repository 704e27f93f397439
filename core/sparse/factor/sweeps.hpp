// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Triangular solves with a supernodal factor for many right-hand sides.
#include <cstdint>
#include <vector>

#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// L as computed by the multifrontal elimination: consecutive panels.
struct FactorView {
  const SupernodeTree* tree = nullptr;
  const double* panels = nullptr;
  /// Supernodes [from, to), which must be complete subtrees: their part of L factorises the
  /// principal block of their unknowns. to = -1: all.
  int32_t from = 0, to = -1;
  /// Rows of L from this index on are ignored; -1: end_index().
  int32_t reach = -1;

  int32_t end() const { return to < 0 ? tree->supernodes() : to; }
  /// First index, and one past the last.
  int32_t first_index() const { return tree->first[from]; }
  int32_t end_index() const { return tree->first[end()]; }
  int32_t reach_index() const { return reach < 0 ? end_index() : reach; }
};

/// Some right-hand sides from the view's first index on: `count` contiguous values per row, rows at
/// distance `stride`. `count` is 1 or a multiple of kLanes.
struct SweepColumns {
  double* at = nullptr;
  int count = 0;
  int64_t stride = 0;
};

/// Target of the updates of rows after the view's last index: `count` values of row j at
/// sums[index[j] * count]. Without sums they go to x, which must then include these rows.
struct RowsAfterView {
  double* sums = nullptr;
  const int32_t* index = nullptr;
};

/// One supernode of the sweeps below; forward steps go up the tree, backward steps down.
void forward_step(const FactorView& L, int32_t s, const SweepColumns& x, std::vector<double>& work,
                  const RowsAfterView& after = {});
void backward_step(const FactorView& L, int32_t s, const SweepColumns& x,
                   std::vector<double>& work);

/// x <- L^{-1} x and x <- L^{-T} x for the unknowns of the view. One thread; L is read
/// once.
void forward_sweep(const FactorView& L, const SweepColumns& x);
void backward_sweep(const FactorView& L, const SweepColumns& x);

}  // namespace clatter::sparse
