// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The inverse of a matrix of a few rows.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <utility>

namespace clatter::dynamics {

/// A <- A^-1 by Gauss-Jordan elimination with pivots scaled by rows, whose units may differ; A has
/// at most 24 rows. False when it is singular or not finite.
template <typename Matrix>
[[nodiscard]] bool invert_small(Matrix& A) {
  constexpr int kMost =
      Matrix::RowsAtCompileTime == Eigen::Dynamic ? 24 : Matrix::RowsAtCompileTime;
  const Eigen::Index n = A.rows();
  std::array<double, kMost> scale;
  std::array<Eigen::Index, kMost> pivots;
  for (Eigen::Index i = 0; i < n; ++i) scale[i] = 1.0 / A.row(i).cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (std::abs(A(i, k)) * scale[i] > std::abs(A(pivot, k)) * scale[pivot]) pivot = i;
    pivots[k] = pivot;
    if (pivot != k) {
      A.row(k).swap(A.row(pivot));
      std::swap(scale[k], scale[pivot]);
    }
    const double by = 1.0 / A(k, k);
    if (!std::isfinite(by)) return false;
    A(k, k) = 1.0;
    A.row(k) *= by;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = A(i, k);
      A(i, k) = 0.0;
      A.row(i) -= factor * A.row(k);
    }
  }
  for (Eigen::Index k = n; k-- > 0;)
    if (pivots[k] != k) A.col(k).swap(A.col(pivots[k]));
  return A.allFinite();
}

}  // namespace clatter::dynamics
