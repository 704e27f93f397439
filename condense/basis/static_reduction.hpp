// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mass of the static shapes of the interior, without storing the shapes.
#include <Eigen/Core>
#include <vector>

#include "condense/basis/dof_partition.hpp"
#include "core/base/matrix.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::condense {

/// Rigid motions that the static shapes must represent: Psi at_boundary = inside.
struct RigidMotions {
  Eigen::MatrixXd at_boundary;  // n_b x m
  Eigen::MatrixXd inside;       // n_i x m
};

/// The stored part of the constraint modes Psi_ib = -K_ii^{-1} K_ib (Guyan 1965; Craig and Bampton
/// 1968, eq. 8).
struct StaticReduction {
  Eigen::MatrixXd K_bb, M_bb;  // of the basis [I; Psi], n_b x n_b
  RowMatrix rows;              // Psi at the requested interior DoFs
  double rigid_error = 0.0;    // |Psi r_b - r_i| / |r_i| of the plain solve
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
///
/// Rounding in the solve would affect the mass properties: rows and M_bb are changed as little as
/// possible so that they represent the rigid motions exactly.
/// @param factor_ii of K.ii with the coupling K.ib. K_bb = K.bb - K_bi K_ii^{-1} K_ib follows from
/// it.
/// @param kept interior DoFs whose rows of Psi are requested.
StaticReduction reduce_statically(const sparse::SupernodalFactor& factor_ii,
                                  const PartitionedMatrix& K, const PartitionedMatrix& M,
                                  const RigidMotions& rigid, const std::vector<int32_t>& kept,
                                  StaticMass method = StaticMass::kCheaper);

/// The same with a factor that gives only solutions: columns of Psi in blocks,
///   M_bb = M_bb + M_bi Psi + Psi^T (M_ii Psi + M_ib),   Psi^T f = -K_bi K_ii^{-1} f,
/// of which none is kept but the requested rows. For a team `kept` and the rows are those of this
/// process.
StaticReduction reduce_by_solves(const sparse::Factor& factor_ii, const PartitionedModel& part,
                                 const RigidMotions& rigid, const std::vector<int32_t>& kept);

}  // namespace clatter::condense
