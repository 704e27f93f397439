// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The modes of K x = lambda M x by count or by frequency, with a proof that none is missing.
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "core/base/sparse.hpp"
#include "core/sparse/eigen/eigen_method.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"
#include "core/sparse/eigen/mode_values.hpp"
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

struct EigenOptions : EigenChoice {
  int count = 0;         // the lowest `count` modes, or
  double fmax_hz = 0.0;  // all modes below this frequency; exactly one of the two is given
  bool prove_count = true;
  double amls_cutoff = 2.5;     // of kAmls: cut-off of substructure modes / frequency
  std::optional<double> sigma;  // shift [rad2/s2]; chosen from the matrices when absent
  /// Free rigid-body motions, n x m with K rigid = 0: modes of 0 Hz that are known in advance. No
  /// columns: nothing is free. Absent: not known.
  std::optional<Eigen::MatrixXd> rigid;
  int max_retries = 2;  // new start vectors after a count mismatch
  uint64_t seed = 1;
  int dense_limit = 300;       // up to this size a dense solver is used
  double max_residual = 1e-5;  // largest accepted residual of a mode
  FactorOptions factor;
  Eigen::VectorXd start;  // first start vector instead of a random one (tests)
};

/// What was proved about the number of modes.
struct CountProof {
  bool proved = false;
  double limit = 0.0;  // [rad2/s2]
  int64_t below = -1;  // eigenvalues below `limit` by inertia
  double seconds = 0.0;
};

struct ModeSet {
  Eigen::VectorXd values;     // lambda [rad2/s2], ascending
  Eigen::MatrixXd vectors;    // n x m, M-orthonormal, largest entry of each positive
  Eigen::VectorXd residuals;  // |K x - lambda M x| / (|lambda - sigma| |M x|); of rigid-body modes
                              // |K x| / (| |K| |x| | + |sigma| |M x|)
  Eigen::VectorXd rounding;   // eps |x|^T |K| |x| / 2 lambda, upper bound: relative change of
                              // a frequency by rounding of K's entries; 0 for rigid-body modes
  Eigen::VectorXd errors;     // of kAmls: estimated relative errors of frequencies; else empty
  int rigid = 0;         // modes of 0 Hz: rigid-body modes, and mechanisms whose lambda is rounding
  int known_rigid = 0;   // of these, rigid-body modes known in advance
  int64_t massless = 0;  // DoFs without mass; each gives an infinite eigenvalue
  double sigma = 0.0;
  double next_value = 0.0;  // lower bound of all modes not listed, as far as known
  std::string method;       // "block-lanczos", "arpack", "amls", "dense"
  CountProof proof;
  FactorReport factor;
  int64_t solves = 0;  // right-hand sides solved with a factor
  int factors = 0;     // of K - sigma M, computed while choosing the shift and after
  int retries = 0;
  double seconds = 0.0;  // of the eigen-solver only

  int size() const { return static_cast<int>(values.size()); }
  /// sqrt(lambda) / 2 pi [Hz]; 0 for rigid-body modes.
  Eigen::VectorXd frequencies_hz() const;
};

/// Modes of K x = lambda M x.
/// @param K, M n x n, symmetric, lower triangle; K positive semidefinite, M positive definite, or
/// semidefinite with zero rows: these give infinite eigenvalues, which are omitted.
/// @param factor of K - options.sigma M if the caller already has it (then sigma must be given).
/// Throws InputError for an invalid request; NumericsError when the solver does not converge, a
/// residual is too large, or the count does not match after all retries.
ModeSet solve_modes(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
                    const Factor* factor = nullptr);

/// The same where a team may share the rows; then by block Lanczos, whatever the size.
ModeSet solve_modes(const MatrixPencil& pencil, const EigenOptions& options,
                    const Factor* factor = nullptr);

}  // namespace clatter::sparse
