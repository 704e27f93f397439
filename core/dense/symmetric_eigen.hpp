// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Eigenvalues of dense symmetric matrices by LAPACK, with all BLAS threads; small ones by Eigen.
#include <Eigen/Core>

namespace clatter::dense {

/// A X = X diag(values) or A X = B X diag(values), values ascending; X is orthonormal (in B).
struct Eigenpairs {
  Eigen::VectorXd values;   // n; all NaN without ok
  Eigen::MatrixXd vectors;  // n x n, the same; empty when only values were requested
  bool ok = false;          // false: not finite, or B is not positive definite
};

enum class EigenParts { kValues, kVectors };

/// Divide and conquer (LAPACK dsyevd), up to 64 rows the QR iteration, whose bits do not depend on
/// the number of threads. Reads the lower triangle of A, n x n.
Eigenpairs symmetric_eigen(Eigen::MatrixXd A, EigenParts parts = EigenParts::kVectors);

/// The same for the pencil (A, B), B positive definite (LAPACK dsygvd).
Eigenpairs symmetric_eigen(Eigen::MatrixXd A, Eigen::MatrixXd B,
                           EigenParts parts = EigenParts::kVectors);

/// The same for a tridiagonal matrix (LAPACK dstevd).
/// @param diagonal n
/// @param below n - 1, beside the diagonal
Eigenpairs tridiagonal_eigen(Eigen::VectorXd diagonal, Eigen::VectorXd below);

}  // namespace clatter::dense
