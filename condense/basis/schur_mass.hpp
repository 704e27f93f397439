// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The static mass of a boundary by elimination.
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::condense {

/// Psi^T M_ii Psi + Psi^T M_ib + M_bi Psi with Psi = -K_ii^{-1} K_ib, which is never formed: the
/// derivative of the Schur complement, -dS/dsigma of K - sigma M at 0 (Leung 1978), n_b x n_b. Each
/// front of M follows the elimination of K: with W = L21 L11^{-1} and N = M21 - W M11 / 2,
///   M22 -= W N^T + N W^T.
/// @param factor_ii of K_ii with K_ib as its boundary. Memory: the update matrices of one
/// elimination; L is read.
Eigen::MatrixXd schur_mass(const sparse::SupernodalFactor& factor_ii, const SparseMatrix& M_ii,
                           const SparseMatrix& M_ib);

/// Floating-point operations of schur_mass().
double schur_mass_flops(const sparse::SupernodeTree& tree);

}  // namespace clatter::condense
