// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One step of subspace iteration with Rayleigh-Ritz.
#include "core/sparse/eigen/shift_invert.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::sparse {

/// X <- the Ritz vectors of (K - sigma M)^{-1} M X, n x m, M-orthonormal, block by block in place;
/// values <- their Rayleigh quotients, ascending. The component at lambda_k in the vector of
/// lambda_j shrinks by (lambda_j - sigma) / (lambda_k - sigma). Throws NumericsError when the
/// vectors are linearly dependent.
void refine_modes(const ShiftInvert& problem, const SymmetricOperator& mass_of, Eigen::MatrixXd& X,
                  Eigen::VectorXd& values);

}  // namespace clatter::sparse
