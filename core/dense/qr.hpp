// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Orthonormal bases of dense matrices by LAPACK.
#include <Eigen/Core>

namespace clatter::dense {

/// A = Q R; k = min(m, n).
struct Qr {
  Eigen::MatrixXd Q;  // m x k, orthonormal
  Eigen::MatrixXd R;  // k x n, zero below the diagonal
};

/// By Householder's reflections without pivoting (LAPACK dgeqrf, dorgqr); A m x n. NaN where A is
/// not finite.
Qr qr(Eigen::MatrixXd A);

}  // namespace clatter::dense
