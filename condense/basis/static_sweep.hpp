// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Constraint modes by one sweep through the elimination tree, where one process has all rows.
#include <Eigen/Core>
#include <vector>

#include "condense/basis/partitioned_model.hpp"
#include "core/base/matrix.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::condense {

/// The stored part of the constraint modes Psi_ib = -K_ii^{-1} K_ib (Guyan 1965; Craig and Bampton
/// 1968, eq. 8).
struct StaticShapes {
  Eigen::MatrixXd M_bb;  // of the basis [I; Psi], n_b x n_b
  RowMatrix rows;        // Psi at the requested interior DoFs
};

/// How the mass of the static shapes is summed: 2 n_i n_b^2 operations of the sweep against about
/// two more eliminations.
enum class StaticMass { kCheaper, kSweep, kElimination };

/// One sweep from the root of the elimination tree to its leaves: the rows of Psi at a supernode
/// follow from those above it on the path, so only the fronts of one path are in memory. Each row
/// is used as soon as it is computed: M_bb += Psi_j^T (M_jj Psi_j / 2 + sum over the rows above
/// M_rj Psi_r) + transpose, in panels at BLAS-3 speed. All columns at once, distributed to the
/// threads. With many boundary coordinates M_bb is computed by elimination (schur_mass.hpp), and
/// the sweep visits only the kept rows.
/// @param factor_ii of K_ii with the coupling K_ib. @param kept interior DoFs whose rows of Psi are
/// requested.
StaticShapes sweep_shapes(const sparse::SupernodalFactor& factor_ii, const PartitionedMatrix& M,
                          const std::vector<int32_t>& kept, StaticMass method);

}  // namespace clatter::condense
