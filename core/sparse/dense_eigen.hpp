// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Eigenvalues of dense symmetric matrices by LAPACK, with all BLAS threads.
#include <Eigen/Core>

namespace clatter::sparse {

/// A X = X diag(values) or A X = B X diag(values), values ascending; X is orthonormal (in B).
struct DenseEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  // empty when only values were requested
  bool ok = false;          // false: not finite, or B is not positive definite
};

enum class EigenParts { kValues, kVectors };

/// Divide and conquer (LAPACK dsyevd). Reads the lower triangle of A, n x n.
DenseEigen symmetric_eigen(const Eigen::MatrixXd& A, EigenParts parts = EigenParts::kVectors);

/// The same for the pencil (A, B), B positive definite (LAPACK dsygvd).
DenseEigen symmetric_eigen(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                           EigenParts parts = EigenParts::kVectors);

}  // namespace clatter::sparse
