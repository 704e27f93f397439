// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Automated multilevel substructuring: many modes at engineering accuracy from modes of
// substructures.
#include "core/sparse/eigen/shifted_pencil.hpp"

namespace clatter::sparse {

struct AmlsOptions {
  int count = 0;           // lowest modes wanted, in addition to those known in advance
  double accuracy = 5e-3;  // largest estimated relative error of a frequency
  /// Modes of substructures are kept up to this multiple of the highest wanted frequency.
  double cutoff = 2.5;
  int leaf = 1500;  // largest number of unknowns of a leaf
  int max_refinements = 4;
  uint64_t seed = 1;
};

/// The lowest modes from modes of substructures (Bennighof and Lehoucq 2004), with the levels of
/// the elimination tree: in y = L^T S^{-1} x, K - sigma M is the unit matrix and M is A of
/// SubtreeProduct, whose diagonal blocks belong to the substructures, with the interiors that they
/// separate moving along statically. A is projected on the dominant eigenvectors of these blocks,
/// so values are upper bounds. Then subspace iteration with the factor (Rayleigh-Ritz, still from
/// above) is repeated until a step lowers no wanted frequency by more than `accuracy`; this
/// decrease is the estimate in EigenResult::errors: the true error after the step is about 1 / (t^2
/// - 1) of it, t the ratio between the eigenvalue of the missing components of a vector and its
/// own. Memory: the vectors, 5 % more than requested (at least 8 more), and two blocks of 32
/// besides the factor; throws NumericsError before allocating when they do not fit.
EigenResult solve_amls(ShiftedPencil& pencil, const AmlsOptions& options);

}  // namespace clatter::sparse
