#pragma once
// The modes of K x = lambda M x by count or by frequency, with a proof that none is missing.
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "core/base/sparse.hpp"
#include "core/sparse/eigen/eigen_method.hpp"
#include "core/sparse/eigen/mode_values.hpp"
#include "core/sparse/eigen/shift_invert.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::sparse {

struct EigenOptions : EigenChoice {
  int count = 0;         // the lowest `count` modes, or
  double fmax_hz = 0.0;  // all modes below this frequency; exactly one of both is given
  bool prove_count = true;
  double amls_cutoff = 2.5;     // of kAmls: modes of parts are kept to this times the frequency
  std::optional<double> sigma;  // shift [rad2/s2]; found from the matrices when absent
  /// Rigid motions that are free, n x m with K rigid = 0: they are modes of 0 Hz and known
  /// beforehand. No columns: nothing is free. Absent: not known.
  std::optional<Eigen::MatrixXd> rigid;
  int max_retries = 2;  // new start vectors after a count mismatch
  uint64_t seed = 1;
  int dense_limit = 300;       // up to this size dense algebra is used
  double max_residual = 1e-5;  // largest accepted residual of a mode
  FactorOptions factor;
  Eigen::VectorXd start;  // first start vector in place of a random one (tests)
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
  Eigen::VectorXd residuals;  // |K x - lambda M x| / (|lambda - sigma| |M x|); of rigid motions
                              // |K x| / | |K| |x| |
  Eigen::VectorXd rounding;   // eps |x|^T |K| |x| / 2 lambda, from above: what rounding of K's
                              // entries may move a frequency by, relative; 0 for rigid modes
  Eigen::VectorXd errors;     // of kAmls: estimated, of frequencies, relative; else empty
  int rigid = 0;              // of 0 Hz: rigid motions, and mechanisms whose lambda is rounding
  int known_rigid = 0;        // of these, rigid motions known beforehand
  int64_t massless = 0;       // unknowns without mass: as many eigenvalues are infinite
  double sigma = 0.0;
  double next_value = 0.0;  // a value that no unlisted mode stays below, as far as is known
  std::string method;       // "block-lanczos", "arpack", "amls", "dense"
  CountProof proof;
  FactorReport factor;
  int64_t solves = 0;  // vectors that went through a factor
  int factors = 0;     // of K - sigma M, made to find the shift and after it
  int retries = 0;
  double seconds = 0.0;  // of the eigen-solver alone

  int size() const { return static_cast<int>(values.size()); }
  /// sqrt(lambda) / 2 pi [Hz]; 0 for rigid modes.
  Eigen::VectorXd frequencies_hz() const;
};

/// Modes of K x = lambda M x.
/// @param K, M n x n, symmetric, lower triangle; K positive semidefinite, M positive definite, or
/// semidefinite with rows that are zero: these give infinite eigenvalues, which are left out.
/// @param factor of K - options.sigma M when the caller has it already (then sigma must be given).
/// Throws InputError for a senseless request; NumericsError when the solver does not converge, a
/// residual is too large, or the count does not match after all retries.
ModeSet solve_modes(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
                    const SupernodalFactor* factor = nullptr);

}  // namespace clatter::sparse
