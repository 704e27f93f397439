// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Singular values of dense matrices by LAPACK.
#include <Eigen/Core>

namespace clatter::dense {

/// A = U diag(values) V^T for the first k = min(m, n) columns of V; NaN where A is not finite.
struct Svd {
  Eigen::MatrixXd U;       // m x k, orthonormal columns
  Eigen::VectorXd values;  // k, descending
  Eigen::MatrixXd V;       // n x n, orthogonal: columns from the rank on are the null space
};

/// By divide and conquer (LAPACK dgesdd); A m x n.
Svd svd(const Eigen::MatrixXd& A);

/// Its singular values alone, min(m, n), descending.
Eigen::VectorXd singular_values(Eigen::MatrixXd A);

/// Orthonormal basis, n x (n - rank), of the x with A x = 0, A m x n with finite numbers.
/// @param tolerance singular values up to this part of the largest count as zero: rounding
Eigen::MatrixXd null_space(const Eigen::MatrixXd& A, double tolerance = 1e-14);

}  // namespace clatter::dense
