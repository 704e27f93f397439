#pragma once
// Triangular solves with a supernodal factor, many right-hand sides at a time.
#include <cstdint>
#include <vector>

#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// L as the multifrontal elimination leaves it: panel after panel.
struct FactorView {
  const SupernodeTree* tree = nullptr;
  const double* panels = nullptr;
  /// Supernodes [from, to), which must be whole subtrees: their part of L factorises the principal
  /// block of their unknowns. to = -1: all.
  int32_t from = 0, to = -1;
  /// Rows of L at this place and behind it take no part; -1: end_place().
  int32_t reach = -1;

  int32_t end() const { return to < 0 ? tree->supernodes() : to; }
  /// First place, and the one behind the last.
  int32_t first_place() const { return tree->first[static_cast<size_t>(from)]; }
  int32_t end_place() const { return tree->first[static_cast<size_t>(end())]; }
  int32_t reach_place() const { return reach < 0 ? end_place() : reach; }
};

/// Some right-hand sides from the view's first place on: `count` values of one place side by side,
/// places at distance `stride`. `count` is 1 or a multiple of kLanes.
struct SweepColumns {
  double* at = nullptr;
  int count = 0;
  int64_t stride = 0;
};

/// Where a forward step puts what it takes from rows behind the view's last place: `count` values
/// of place j at sums[index[j] * count]. Without sums they go to x, which must then hold these
/// places.
struct BehindView {
  double* sums = nullptr;
  const int32_t* index = nullptr;
};

/// One supernode of the sweeps below; forward steps go upwards, backward steps downwards.
void forward_step(const FactorView& L, int32_t s, const SweepColumns& x, std::vector<double>& work,
                  const BehindView& behind = {});
void backward_step(const FactorView& L, int32_t s, const SweepColumns& x,
                   std::vector<double>& work);

/// x <- L^{-1} x and x <- L^{-T} x for the unknowns of the view. One thread; L is read
/// once.
void forward_sweep(const FactorView& L, const SweepColumns& x);
void backward_sweep(const FactorView& L, const SweepColumns& x);

}  // namespace clatter::sparse
