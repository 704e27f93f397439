// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All eigenpairs of a small model by dense algebra: the fallback where Lanczos has no subspace
// (hard case A6), and the reference of the tests.
#include <optional>

#include "core/base/sparse.hpp"
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

/// Solves M x = nu (K - sigma M) x, lambda = sigma + 1 / nu, so that the low modes are the most
/// accurate. K, M n x n, symmetric, both triangles filled; K - sigma M positive definite. Returns
/// the `count` lowest pairs (0: all with nu > 0), M-orthonormal. kBadInput when K - sigma M is not
/// definite.
EigenResult solve_dense(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, double sigma,
                        int count = 0);

/// The same with known rigid-body motions (r x m, M-orthonormal, K rigid = 0; may have no columns)
/// projected out, and with shifts chosen from the spectrum: 0 where nothing is rigid and K is
/// definite, else negative and close to the lowest value; values more than 1e8 times farther from
/// the shift than the lowest get their own shift, so that all are accurate. @param sigma a single
/// shift to use instead.
EigenResult solve_dense(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M,
                        const Eigen::MatrixXd& rigid, std::optional<double> sigma, int count = 0);

/// A negative shift well below the elastic eigenvalues of a reduced model: a thousandth of the
/// median of K_jj / M_jj. (The minimum may be zero: a rigid-body motion can move a single
/// coordinate.)
double dense_shift(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

/// Both triangles of a sparse symmetric matrix given by its lower one.
Eigen::MatrixXd dense_symmetric(const SparseMatrix& lower);

}  // namespace clatter::sparse
