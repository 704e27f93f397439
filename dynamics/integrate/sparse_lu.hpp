// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// LU of a sparse matrix whose pattern stays while its values change.
#include <memory>
#include <vector>

namespace clatter::dynamics {

/// KLU (Davis and Natarajan 2010) with one analysis per pattern. The pivots of a
/// factorisation are kept for the next values as long as they are good (`factor`).
class SparseLu {
 public:
  /// Pattern by columns: the rows of column j are rows[starts[j]] .. rows[starts[j + 1] - 1],
  /// ascending; n + 1 starts. NumericsError when the analysis fails.
  SparseLu(std::vector<int> starts, std::vector<int> rows);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  int size() const;
  int nonzeros() const;         // of the matrix
  int factor_nonzeros() const;  // of L and U, after the first factorisation

  /// Factors a matrix with these values, in the order of the pattern's rows. Pivots of the last
  /// factorisation are taken over unless entries of U then grow beyond 1e8 of those of the matrix.
  /// False when the matrix is singular or not finite.
  [[nodiscard]] bool factor(std::vector<double>& values);
  /// x <- A^-1 x, n.
  void solve(double* x) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter::dynamics
