#pragma once
// What is done with modes once they are found: residuals, the order of the unknowns, signs.
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::sparse {

/// |K x - lambda M x| / (|lambda - sigma| |M x|) of each mode; K, M and vectors in one order.
Eigen::VectorXd residuals_of(const SymmetricProduct& K, const SymmetricProduct& M,
                             const ModeSet& modes);

/// |K x - lambda M x| / ( | |K| |x| | + |lambda| |M x| ) of one mode, the relative change of
/// entries that explains its residual, over 1e-12: above 1 there is more than rounding in it.
double beyond_rounding(const SparseMatrix& K, const SparseMatrix& M, double value,
                       const Eigen::VectorXd& x);

/// Throws NumericsError naming the first mode whose residual is above `most` and more than rounding
/// of the entries explains (beyond_rounding).
void refuse_residuals(const SparseMatrix& K, const SparseMatrix& M, const ModeSet& modes,
                      double most);

/// Puts the vectors' rows where the unknowns stand, row order[i] from row i (none: as they are),
/// and makes the largest entry of each vector positive.
void present(const std::vector<int64_t>& order, ModeSet& modes);

/// Puts the known rigid modes (n x m, M-orthonormal) before the others, finds what rounding of K
/// may move the frequencies by, and counts the modes of 0 Hz: known ones, and mechanisms whose
/// lambda is within that rounding of zero. @param known_beforehand `rigid` holds all rigid motions;
/// else values below 1e-10 of the shift count as zero too.
void take_rigid(const SparseMatrix& K, const Eigen::MatrixXd& rigid, bool known_beforehand,
                ModeSet& modes);

}  // namespace clatter::sparse
