// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Dense systems of any shape and rank by LAPACK.
#include <Eigen/Core>

namespace clatter::dense {

struct LeastSquares {
  Eigen::MatrixXd X;      // n x k; NaN where A is not finite
  Eigen::Index rank = 0;  // of A
};

/// X of least norm among those with the least |A X - B|, by a complete orthogonal decomposition
/// (LAPACK dgelsy).
/// @param A m x n
/// @param B m x k
/// @param tolerance a part of A with a condition above 1 / tolerance counts as zero; without it the
///        rounding of A, eps max(m, n)
LeastSquares least_squares(Eigen::MatrixXd A, const Eigen::MatrixXd& B, double tolerance = -1.0);

/// A^+, n x m (Moore and Penrose), by the same decomposition.
Eigen::MatrixXd pseudo_inverse(Eigen::MatrixXd A, double tolerance = -1.0);

}  // namespace clatter::dense
