#pragma once
// Triangular solves with a supernodal factor, many right-hand sides at a time.
#include <cstdint>

#include "modal/factor/supernode_tree.hpp"

namespace clatter::modal {

/// L as the multifrontal elimination leaves it: panel after panel.
struct FactorView {
  const SupernodeTree* tree = nullptr;
  const double* panels = nullptr;
};

/// Some right-hand sides: `count` values of one place side by side, places at distance `stride`.
/// `count` is 1 or a multiple of kLanes.
struct SweepColumns {
  double* at = nullptr;
  int count = 0;
  int64_t stride = 0;
};

/// x <- L^{-1} x and x <- L^{-T} x for the n eliminated unknowns. One thread; L is read once.
void forward_sweep(const FactorView& L, const SweepColumns& x);
void backward_sweep(const FactorView& L, const SweepColumns& x);

}  // namespace clatter::modal
