// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Block Lanczos with thick restart: reads the factor once for a block of vectors, which makes it
// several times faster than ARPACK for many modes.
#include <functional>
#include <optional>

#include "core/sparse/eigen/krylov_basis.hpp"
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

/// Ratio of smallest to largest nu that one factor resolves to the tolerance.
inline constexpr double kSpread = 1e-4;

struct BlockLanczosOptions {
  int count = 0;             // pairs wanted
  int block = 0;             // vectors per block, a multiple of kLanes; 0: chosen from `count`
  int basis = 0;             // largest subspace; 0: chosen from `count`
  double tolerance = 1e-10;  // |Op x - nu x|_M / nu; the error of nu is its square
  std::optional<Storage> storage;  // of the basis; absent: as memory allows
  int max_restarts = 50;
  uint64_t seed = 1;      // of the random start block
  Eigen::MatrixXd start;  // first columns of the start block when not empty (tests)
  /// Receives lambda of the Ritz values with nu > 0 of the first kProbeBlocks blocks, ascending:
  /// each is above an exact one. Returning false ends the run with kStopped to take another shift.
  std::function<bool(const Eigen::VectorXd& values)> go_on;
};

/// Number of blocks that locate the start of the spectrum.
inline constexpr int kProbeBlocks = 3;

/// Columns of the basis and their storage.
struct BasisSize {
  Eigen::Index columns = 0;
  Storage storage = Storage::kMemory;
};

/// The basis that `left_gib` of memory allow for `size` unknowns: no restart with few modes, then
/// restarts, then a short basis, then disk storage.
BasisSize basis_size(const BlockLanczosOptions& options, Eigen::Index block, Eigen::Index size,
                     double left_gib);

/// lambda of the Ritz values of kProbeBlocks blocks of eight from a random start, as passed to
/// go_on.
Eigen::VectorXd first_ritz_values(const ShiftInvert& problem, uint64_t seed);

/// The `count` lowest eigenpairs of K x = lambda M x from the projection of Op = (K - sigma M)^{-1}
/// M on span{X, Op X, Op^2 X, ...} with two passes of orthogonalisation in the M inner product
/// (Grimes, Lewis and Simon, 1994), restarted from the wanted Ritz vectors and the residual block
/// (Wu and Simon, Thick-restart Lanczos, 2000). A block of size b finds up to b copies of a
/// multiple eigenvalue. A pair is converged at `tolerance` of its nu, or of the rounding level set
/// by the largest one, kSpread nu_1.
EigenResult solve_block_lanczos(const ShiftInvert& problem, const BlockLanczosOptions& options);

}  // namespace clatter::sparse
