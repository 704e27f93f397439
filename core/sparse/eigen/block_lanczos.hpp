#pragma once
// Block Lanczos with thick restart: reads the factor once for a whole block of vectors, which
// makes it several times faster than ARPACK where many modes are wanted.
#include <functional>
#include <optional>

#include "core/sparse/eigen/krylov_basis.hpp"
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

/// Smallest nu over the largest that one factor resolves to the tolerance.
inline constexpr double kSpread = 1e-4;

struct BlockLanczosOptions {
  int count = 0;             // pairs wanted
  int block = 0;             // vectors a block, in whole kLanes; 0: chosen from `count`
  int basis = 0;             // largest subspace; 0: chosen from `count`
  double tolerance = 1e-10;  // |Op x - nu x|_M / nu of each pair; nu is then right to its square
  std::optional<Storage> storage;  // of the basis; else as memory allows
  int max_restarts = 50;
  uint64_t seed = 1;      // of the random start block
  Eigen::MatrixXd start;  // first columns of the start block when not empty (tests)
  /// Sees lambda of the Ritz values of the first kLookBlocks blocks, ascending, those with nu > 0:
  /// each is above a true one. False ends the run with kStopped: another shift is to be taken.
  std::function<bool(const Eigen::VectorXd& values)> go_on;
};

/// Blocks that show where the spectrum begins.
inline constexpr int kLookBlocks = 3;

/// Columns of the basis and where they stand.
struct BasisRoom {
  Eigen::Index columns = 0;
  Storage storage = Storage::kMemory;
};

/// What a memory of `left_gib` allows for a problem of `size` unknowns: no restart with few modes,
/// then restarts, then a short basis, then the disk.
BasisRoom basis_room(const BlockLanczosOptions& options, Eigen::Index block, Eigen::Index size,
                     double left_gib);

/// lambda of the Ritz values of kLookBlocks blocks of eight from a random start, as go_on sees
/// them.
Eigen::VectorXd first_ritz_values(const ShiftInvert& problem, uint64_t seed);

/// The `count` lowest eigenpairs of K x = lambda M x from the projection of Op = (K - sigma M)^{-1}
/// M on span{X, Op X, Op^2 X, ...} with two passes of orthogonalisation in the M inner product
/// (Grimes, Lewis and Simon, 1994), restarted from the wanted Ritz vectors and the residual block
/// (Wu and Simon, Thick-restart Lanczos, 2000). A block of size b finds up to b copies of a
/// multiple eigenvalue. A pair is converged at `tolerance` of its nu, or of what rounding leaves of
/// it beside the largest one, kSpread nu_1.
EigenResult solve_block_lanczos(const ShiftInvert& problem, const BlockLanczosOptions& options);

}  // namespace clatter::sparse
