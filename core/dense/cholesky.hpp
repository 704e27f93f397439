// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cholesky factors of dense matrices by LAPACK.
#include <Eigen/Core>

namespace clatter::dense {

/// A = L L^T of a symmetric positive definite matrix (LAPACK dpotrf).
class Cholesky {
 public:
  /// Reads the lower triangle of A, n x n.
  explicit Cholesky(Eigen::MatrixXd A);
  /// False: A is not finite or not positive definite. The other functions then return NaN.
  bool ok() const { return ok_; }
  /// L, n x n, zero above the diagonal.
  Eigen::MatrixXd lower() const;
  /// A^-1 B, B n x m.
  Eigen::MatrixXd solve(Eigen::MatrixXd B) const;
  /// L^-1 B, B n x m.
  Eigen::MatrixXd solve_lower(Eigen::MatrixXd B) const;
  /// L^-T B, B n x m.
  Eigen::MatrixXd solve_upper(Eigen::MatrixXd B) const;
  /// Estimate of 1 / (|A|_1 |A^-1|_1), by LAPACK dpocon; 0 without ok().
  double reciprocal_condition() const;

 private:
  Eigen::MatrixXd triangle_solved(char transposed, Eigen::MatrixXd B) const;

  Eigen::MatrixXd factor_;  // L; A above the diagonal
  double size_ = 0.0;       // |A|_1
  bool ok_ = false;
};

}  // namespace clatter::dense
