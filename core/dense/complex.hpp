// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// General and complex eigenvalues, and complex systems, by LAPACK. What has no solution is NaN.
#include <Eigen/Core>

namespace clatter::dense {

/// Eigenvalues of a general A, n x n, in LAPACK's order (dgeev); pairs of conjugates follow each
/// other.
Eigen::VectorXcd eigenvalues(Eigen::MatrixXd A);

/// A X = X diag(values), columns of X of length one.
struct ComplexEigenpairs {
  Eigen::VectorXcd values;   // n
  Eigen::MatrixXcd vectors;  // n x n
};

/// Of a general complex A, n x n (LAPACK zgeev).
ComplexEigenpairs complex_eigen(Eigen::MatrixXcd A);

/// X of A X = B by LU with partial pivoting (LAPACK zgesv); A n x n, B n x m.
Eigen::MatrixXcd solve_complex(Eigen::MatrixXcd A, Eigen::MatrixXcd B);

/// Orthonormal basis, m x k, of the columns of A, m x n, k = min(m, n), by Householder's
/// reflections (LAPACK zgeqrf, zungqr).
Eigen::MatrixXcd orthonormal(Eigen::MatrixXcd A);

}  // namespace clatter::dense
