// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Dense complex systems by LAPACK, with all BLAS threads.
#include <Eigen/Core>
#include <vector>

namespace clatter::sound {

/// Factors of a dense matrix A by partial pivoting (LAPACK zgetrf, zgecon), in its own memory.
class ComplexLu {
 public:
  /// @param A_transposed n x n: A is stored by rows
  explicit ComplexLu(Eigen::MatrixXcd A_transposed);
  /// Estimate of |A|_1 |A^-1|_1; infinite when A is singular, which must not be solved.
  double condition() const { return condition_; }
  /// X of A X = Y, n x m.
  Eigen::MatrixXcd solve(Eigen::MatrixXcd Y) const { return substituted('T', std::move(Y)); }
  /// X of A^T X = Y, n x m.
  Eigen::MatrixXcd solve_transposed(Eigen::MatrixXcd Y) const {
    return substituted('N', std::move(Y));
  }

 private:
  Eigen::MatrixXcd substituted(char which, Eigen::MatrixXcd Y) const;

  Eigen::MatrixXcd factors_;
  std::vector<int> pivots_;
  double condition_;
};

/// B V for B stored by rows (BLAS zgemm).
/// @param B_transposed p x n; @param V p x m
Eigen::MatrixXcd rows_product(const Eigen::MatrixXcd& B_transposed, const Eigen::MatrixXcd& V);

}  // namespace clatter::sound
