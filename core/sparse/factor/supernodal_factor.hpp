// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sparse supernodal Cholesky factorisation with accuracy checks, and solves at BLAS-3 speed.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/sparse.hpp"
#include "core/sparse/factor/supernode_tree.hpp"
#include "core/sparse/factor/sweeps.hpp"

namespace clatter::sparse {

struct FactorOptions {
  Ordering ordering = Ordering::kMetis;
  std::vector<int64_t> permutation;  // used instead of an ordering when not empty
  double memory_limit_gib = 0.0;     // 0: memory left to the process
  double min_rcond = 1e-13;          // smallest accepted ratio of pivots (hard case C2)
  double max_condition = 1e11;       // largest accepted |A| |x| / |b| of a random solve (A1)
};

/// Cost and accuracy of a factorisation.
struct FactorReport {
  int64_t size = 0;
  int64_t entries = 0;           // of L, including zeros stored in blocks
  double flops = 0.0;            // of the numeric factorisation
  double predicted_gib = 0.0;    // L, update matrices, copies of A during factorisation
  std::string ordering;          // "metis", "amd", "natural", "given"
  double rcond = 0.0;            // (min L_jj / max L_jj)^2 of the scaled matrix
  double probe_residual = 0.0;   // |A x - b| / |b| for a random b
  double probe_condition = 0.0;  // |A| |x| / |b| of that solve: lower bound of condition
  double analyse_seconds = 0.0;
  double factor_seconds = 0.0;
};

/// The matrix is not positive definite, or singular to working precision. `column` is where the
/// factorisation stopped, or -1 if unknown.
struct NotPositiveDefinite : NumericsError {
  NotPositiveDefinite(const std::string& message, int64_t stopped_at)
      : NumericsError(message), column(stopped_at) {}
  int64_t column;
};

/// diag(A)^(-1/2) rounded to powers of two, so that scaling adds no rounding error and pivots do
/// not depend on units. Throws NotPositiveDefinite where the diagonal is not positive.
std::vector<double> power_of_two_scale(const SparseMatrix& lower);

/// P S A S P^T = L L^T with S = power_of_two_scale(A). A is symmetric positive definite, given by
/// its lower triangle. With a boundary, [A C; C^T B], eliminating A also gives L_b = C^T S L^{-T}
/// and the Schur complement B - C^T A^{-1} C at no extra cost.
class SupernodalFactor {
 public:
  /// Orders, predicts memory, factorises and checks accuracy. Throws NotPositiveDefinite, or
  /// NumericsError when L would not fit into memory.
  explicit SupernodalFactor(const SparseMatrix& lower, const FactorOptions& options = {});
  /// @param coupling C, n x n_b.
  SupernodalFactor(const SparseMatrix& lower, const SparseMatrix& coupling,
                   const FactorOptions& options = {});
  /// Orders and predicts only; no numeric factorisation.
  static FactorReport predict(const SparseMatrix& lower, const FactorOptions& options = {});
  ~SupernodalFactor();
  SupernodalFactor(SupernodalFactor&&) noexcept;
  SupernodalFactor& operator=(SupernodalFactor&&) noexcept;

  /// x = A^{-1} b, b is n x m; blocks of right-hand sides are distributed to the threads.
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// The same in place for row-major vectors in elimination order (permutation()): value c of row j
  /// is x[j * count + c]. Nothing is copied.
  void solve_in_order(double* x, int count) const;

  int64_t size() const;
  const FactorReport& report() const;
  /// Row of A at row j of the factor, n entries.
  std::vector<int64_t> permutation() const;

  /// C^T A^{-1} f, n_b x m, for f of n x m: only the forward sweep including L_b, half of a solve.
  Eigen::MatrixXd boundary_product(const Eigen::Ref<const Eigen::MatrixXd>& f) const;
  /// C^T A^{-1} C, n_b x n_b.
  const Eigen::MatrixXd& boundary_part() const;
  const SupernodeTree& tree() const;
  /// Diagonal of S in the order of A.
  const std::vector<double>& scale() const;
  FactorView view() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter::sparse
