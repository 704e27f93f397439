// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sparse supernodal Cholesky factorisation with accuracy checks, and solves at BLAS-3 speed.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/sparse/factor/factor.hpp"
#include "core/sparse/factor/supernode_tree.hpp"
#include "core/sparse/factor/sweeps.hpp"

namespace clatter::sparse {

/// diag(A)^(-1/2) rounded to powers of two, so that scaling adds no rounding error and pivots do
/// not depend on units. Throws NotPositiveDefinite where the diagonal is not positive.
std::vector<double> power_of_two_scale(const SparseMatrix& lower);

/// P S A S P^T = L L^T with S = power_of_two_scale(A). A is symmetric positive definite, given by
/// its lower triangle. With a boundary, [A C; C^T B], eliminating A also gives L_b = C^T S L^{-T}
/// and the Schur complement B - C^T A^{-1} C at no extra cost.
class SupernodalFactor : public Factor {
 public:
  /// Orders, predicts memory, factorises and checks accuracy. Throws NotPositiveDefinite, or
  /// NumericsError when L would not fit into memory.
  explicit SupernodalFactor(const SparseMatrix& lower, const FactorOptions& options = {});
  /// @param coupling C, n x n_b.
  SupernodalFactor(const SparseMatrix& lower, const SparseMatrix& coupling,
                   const FactorOptions& options = {});
  /// Orders and predicts only; no numeric factorisation.
  static FactorReport predict(const SparseMatrix& lower, const FactorOptions& options = {});
  ~SupernodalFactor() override;
  SupernodalFactor(SupernodalFactor&&) noexcept;
  SupernodalFactor& operator=(SupernodalFactor&&) noexcept;

  /// x = A^{-1} b, b is n x m; blocks of right-hand sides are distributed to the threads.
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const override;
  /// The same in place for row-major vectors in elimination order (permutation()): value c of row j
  /// is x[j * count + c]. Nothing is copied.
  void solve_in_order(double* x, int count) const override;

  int64_t size() const;
  const FactorReport& report() const override;
  /// Row of A at row j of the factor, n entries.
  std::vector<int64_t> permutation() const override;

  /// C^T A^{-1} f, n_b x m, for f of n x m: only the forward sweep including L_b, half of a solve.
  Eigen::MatrixXd boundary_product(const Eigen::Ref<const Eigen::MatrixXd>& f) const override;
  /// C^T A^{-1} C, n_b x n_b.
  const Eigen::MatrixXd& boundary_part() const override;
  const SupernodeTree& tree() const;
  /// Diagonal of S in the order of A.
  const std::vector<double>& scale() const;
  FactorView view() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter::sparse
