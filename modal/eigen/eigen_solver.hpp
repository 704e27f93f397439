#pragma once
// The modes of K x = lambda M x by count or by frequency, with a proof that none is missing.
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "core/sparse.hpp"
#include "modal/eigen/eigen_method.hpp"
#include "modal/eigen/mode_values.hpp"
#include "modal/eigen/shift_invert.hpp"
#include "modal/factor/supernodal_factor.hpp"

namespace clatter::modal {

struct EigenOptions : EigenChoice {
  int count = 0;         // the lowest `count` modes, or
  double fmax_hz = 0.0;  // all modes below this frequency; exactly one of both is given
  bool prove_count = true;
  double amls_cutoff = 2.5;     // of kAmls: modes of parts are kept to this times the frequency
  std::optional<double> sigma;  // shift [rad2/s2]; chosen by default_shift when absent
  int max_retries = 2;          // new start vectors after a count mismatch
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
  Eigen::VectorXd residuals;  // |K x - lambda M x| / (|lambda - sigma| |M x|)
  Eigen::VectorXd errors;     // of kAmls: estimated, of frequencies, relative; else empty
  int rigid = 0;              // modes with |lambda| below 1e-6 of the first elastic one
  double sigma = 0.0;
  double next_value = 0.0;  // a value that no unlisted mode stays below, as far as is known
  std::string method;       // "block-lanczos", "arpack", "amls", "dense"
  CountProof proof;
  FactorReport factor;
  int64_t solves = 0;
  int retries = 0;
  double seconds = 0.0;  // of the eigen-solver alone

  int size() const { return static_cast<int>(values.size()); }
  /// sqrt(lambda) / 2 pi [Hz]; 0 for rigid modes.
  Eigen::VectorXd frequencies_hz() const;
};

/// Modes of K x = lambda M x.
/// @param K, M n x n, symmetric, lower triangle; K positive semidefinite, M positive definite.
/// @param factor of K - options.sigma M when the caller has it already (then sigma must be given).
/// Throws InputError for a senseless request; NumericsError when the solver does not converge, a
/// residual is too large, or the count does not match after all retries.
ModeSet solve_modes(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
                    const SupernodalFactor* factor = nullptr);

}  // namespace clatter::modal
