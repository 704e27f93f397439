// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Dense complex systems by LAPACK, with all BLAS threads.
#include <Eigen/Core>

namespace clatter::sound {

/// X of A X = Y, and how well it is determined.
struct ComplexSolution {
  Eigen::MatrixXcd X;      // n x m
  double condition = 0.0;  // estimate of |A|_1 |A^-1|_1; infinite when A is singular
};

/// Solves by LU with partial pivoting (LAPACK zgetrf, zgecon, zgetrs), in the memory of A.
/// @param A_transposed n x n: A is stored by rows
/// @param Y n x m
ComplexSolution solve_dense(Eigen::MatrixXcd A_transposed, Eigen::MatrixXcd Y);

/// B V for B stored by rows (BLAS zgemm).
/// @param B_transposed p x n; @param V p x m
Eigen::MatrixXcd rows_product(const Eigen::MatrixXcd& B_transposed, const Eigen::MatrixXcd& V);

}  // namespace clatter::sound
