// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Square dense systems by LAPACK. What has no solution is NaN: A is singular or not finite.
#include <Eigen/Core>

namespace clatter::dense {

/// X of A X = B by LU with partial pivoting (LAPACK dgesv); A n x n, B n x m.
Eigen::MatrixXd solve(Eigen::MatrixXd A, Eigen::MatrixXd B);

/// The same for a symmetric A, which may be indefinite (Bunch and Kaufman 1977, LAPACK dsysv);
/// reads its lower triangle.
Eigen::MatrixXd solve_symmetric(Eigen::MatrixXd A, Eigen::MatrixXd B);

}  // namespace clatter::dense
