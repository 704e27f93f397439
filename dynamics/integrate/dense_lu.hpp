// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// LU of a dense matrix whose size changes from factor to factor.
#include <Eigen/Core>
#include <vector>

namespace clatter::dynamics {

/// PA = LU by LAPACK (dgetrf) in memory that only grows.
class DenseLu {
 public:
  /// The n x n matrix to be filled in before factor().
  Eigen::Map<Eigen::MatrixXd> matrix(Eigen::Index n);
  /// Factors it in place; false when a pivot is zero or not finite.
  [[nodiscard]] bool factor();
  /// x <- A^-1 x, n numbers.
  void solve(double* x) const;

 private:
  int n_ = 0;
  std::vector<double> memory_;
  std::vector<int> pivots_;
};

}  // namespace clatter::dynamics
