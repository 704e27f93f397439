#pragma once
// Static shapes of the interior under unit displacements of the boundary.
#include <Eigen/Core>

#include "core/sparse.hpp"
#include "modal/factor/supernodal_factor.hpp"

namespace clatter::condense {

/// Psi_ib = -K_ii^{-1} K_ib (Guyan 1965; Craig and Bampton 1968, eq. 8), n_i x n_b, in blocks of
/// right-hand sides.
Eigen::MatrixXd constraint_modes(const modal::SupernodalFactor& factor_ii, const SparseMatrix& K_ib);

/// Adds to Psi_ib the smallest change that makes it carry the rigid motions exactly,
/// Psi r_b = r_i: rounding in the solve would else stand in the mass properties.
/// @param rigid_b, rigid_i n_b x m and n_i x m: the m motions that the body is free to make.
/// Returns |Psi r_b - r_i| / |r_i| before the change.
double restore_rigid_motions(Eigen::MatrixXd& Psi_ib, const Eigen::MatrixXd& rigid_b,
                             const Eigen::MatrixXd& rigid_i);

}  // namespace clatter::condense
