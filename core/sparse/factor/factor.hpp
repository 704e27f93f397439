// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the stages need of a factorisation, by this process alone or by a team.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/sparse/factor/ordering.hpp"

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

/// A factorised symmetric positive definite matrix A, n x n, with an optional boundary C, n x n_b.
/// Tall matrices have the rows of this process, in the order of A.
class Factor {
 public:
  virtual ~Factor() = default;
  /// x = A^{-1} b, b is n x m.
  virtual Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const = 0;
  /// The same in place for row-major vectors in elimination order (permutation()): value c of row j
  /// is x[j * count + c].
  virtual void solve_in_order(double* x, int count) const = 0;
  /// C^T A^{-1} f, n_b x m, for f of n x m.
  virtual Eigen::MatrixXd boundary_product(const Eigen::Ref<const Eigen::MatrixXd>& f) const = 0;
  /// C^T A^{-1} C, n_b x n_b.
  virtual const Eigen::MatrixXd& boundary_part() const = 0;
  virtual const FactorReport& report() const = 0;
  /// Row of A at row j of solve_in_order(); empty: the same.
  virtual std::vector<int64_t> permutation() const = 0;

 protected:
  Factor() = default;
  Factor(const Factor&) = default;
  Factor& operator=(const Factor&) = default;
};

}  // namespace clatter::sparse
