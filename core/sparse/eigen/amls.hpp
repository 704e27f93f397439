#pragma once
// Automated multilevel substructuring: many modes at engineering accuracy from the modes of parts.
#include "core/sparse/eigen/shifted_pencil.hpp"

namespace clatter::sparse {

struct AmlsOptions {
  int count = 0;           // lowest modes wanted, beside those known beforehand
  double accuracy = 5e-3;  // largest relative error of a frequency, as estimated
  /// Modes of substructures are kept up to this multiple of the highest wanted frequency.
  double cutoff = 2.5;
  int leaf = 1500;  // most unknowns of a leaf
  int max_refinements = 4;
  uint64_t seed = 1;
};

/// The lowest modes from the modes of substructures (Bennighof and Lehoucq 2004), with the levels
/// of elimination of the factor: in y = L^T S^{-1} x, K - sigma M is the unit matrix and M is A of
/// SubtreeProduct, whose diagonal blocks belong to the substructures with what they part carried
/// along. A is projected on the dominant eigenvectors of these blocks, so that values come out from
/// above. Then steps of subspace iteration with the factor (Rayleigh-Ritz, values still from above)
/// until the last one lowered no wanted frequency by more than `accuracy`; what it lowered is the
/// estimate in EigenResult::errors: the true error behind the step is about 1 / (t^2 - 1) of it,
/// t the ratio between the eigenvalue of what a vector still lacks and its own.
/// Memory: the vectors, a twentieth more than asked for (8 at least), and two blocks of 32 beside
/// the factor; throws NumericsError before it takes any when they do not fit.
EigenResult solve_amls(ShiftedPencil& pencil, const AmlsOptions& options);

}  // namespace clatter::sparse
