#pragma once
// All eigenpairs of a small model by dense algebra: the fallback where Lanczos has no room (hard
// case A6), and the oracle of the tests.
#include <optional>

#include "core/base/sparse.hpp"
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

/// Solves M x = nu (K - sigma M) x, lambda = sigma + 1 / nu, so that the low modes are the accurate
/// ones. K, M n x n, symmetric, both triangles filled; K - sigma M positive definite. Gives the
/// `count` lowest pairs (0: all with nu > 0), M-orthonormal. kBadInput when K - sigma M is not
/// definite.
EigenResult solve_dense(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, double sigma,
                        int count = 0);

/// The same with the motions that are known to be rigid (r x m, M-orthonormal, K rigid = 0; may
/// have no columns) taken out, so that only the others are found, and with shifts found from the
/// spectrum itself: 0 where nothing is rigid and K is definite, else negative and close to the
/// lowest value; values more than 1e8 times farther from the shift than the lowest come from a
/// shift of their own, so that all keep their digits. @param sigma the one shift to take instead.
EigenResult solve_dense(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M,
                        const Eigen::MatrixXd& rigid, std::optional<double> sigma, int count = 0);

/// A negative shift well below the elastic eigenvalues of a reduced model: a thousandth of the
/// median of K_jj / M_jj. (The least may be zero: a rigid motion can move a coordinate alone.)
double dense_shift(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M);

/// Both triangles of a sparse symmetric matrix that is given by its lower one.
Eigen::MatrixXd dense_symmetric(const SparseMatrix& lower);

}  // namespace clatter::sparse
