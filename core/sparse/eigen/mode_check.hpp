// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Post-processing of computed modes: residuals, original row order, signs.
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"

namespace clatter::sparse {

/// |K x - lambda M x| / (|lambda - sigma| |M x|) of each mode; K, M and vectors in the same row
/// order.
Eigen::VectorXd residuals_of(const SymmetricOperator& K, const SymmetricOperator& M,
                             const ModeSet& modes, const RowTeam& team = one_process());

/// |K x - lambda M x| / ( | |K| |x| | + |lambda| |M x| ) of one mode, the relative change of
/// entries that explains its residual, over 1e-12: above 1 rounding alone does not explain it.
double beyond_rounding(const MatrixPencil& pencil, double value, const Eigen::VectorXd& x);

/// Throws NumericsError naming the first mode whose residual is above `most` and larger than
/// rounding of the entries explains (beyond_rounding).
void refuse_residuals(const MatrixPencil& pencil, const ModeSet& modes, double most);

/// Restores the original row order, row order[i] from row i (empty: unchanged), and makes the
/// largest entry of each vector positive.
void restore_order(const std::vector<int64_t>& order, ModeSet& modes,
                   const RowTeam& team = one_process());

/// Inserts the known rigid-body modes (n x m, M-orthonormal) before the others, bounds the effect
/// of rounding of K on the frequencies, and counts the modes of 0 Hz: known ones, and mechanisms
/// whose lambda is within that rounding of zero. @param known_beforehand `rigid` holds all
/// rigid-body motions; otherwise values below 1e-10 of the shift also count as zero.
void insert_rigid(const MatrixPencil& pencil, const Eigen::MatrixXd& rigid, bool known_beforehand,
                  ModeSet& modes);

}  // namespace clatter::sparse
