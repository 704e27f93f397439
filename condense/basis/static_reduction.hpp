// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mass of the static shapes of the interior, without storing the shapes.
#include <Eigen/Core>
#include <vector>

#include "condense/basis/partitioned_model.hpp"
#include "condense/basis/static_sweep.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter::condense {

/// Rigid motions that the static shapes must represent: Psi at_boundary = inside.
struct RigidMotions {
  Eigen::MatrixXd at_boundary;  // n_b x m
  Eigen::MatrixXd inside;       // n_i x m
};

/// The stiffness on the basis [I; Psi] as well.
struct StaticReduction : StaticShapes {
  Eigen::MatrixXd K_bb;      // n_b x n_b
  double rigid_error = 0.0;  // |Psi r_b - r_i| / |r_i| of the plain solve
};

/// The constraint modes, by a sweep where this process has all rows (static_sweep.hpp), else by
/// solves, and K_bb = K.bb - K_bi K_ii^{-1} K_ib from the factor.
///
/// Rounding in the solve would affect the mass properties: rows and M_bb are changed as little as
/// possible so that they represent the rigid motions exactly.
/// @param factor_ii of K_ii with the coupling K_ib. @param kept interior DoFs of this process whose
/// rows of Psi are requested.
StaticReduction reduce_statically(const PartitionedModel& part, const sparse::Factor& factor_ii,
                                  const RigidMotions& rigid, const std::vector<int32_t>& kept,
                                  StaticMass method = StaticMass::kCheaper);

/// With a factor that gives only solutions: columns of Psi in blocks,
///   M_bb = M_bb + M_bi Psi + Psi^T (M_ii Psi + M_ib),   Psi^T f = -K_bi K_ii^{-1} f,
/// of which none is kept but the requested rows.
StaticShapes shapes_by_solves(const PartitionedModel& part, const sparse::Factor& factor_ii,
                              const std::vector<int32_t>& kept);

/// Results for a boundary that do not depend on the modes added.
struct StaticPart : InteriorFactor {
  StaticReduction reduction;
};

/// Factorises K_ii and reduces statically (Guyan 1965). Steps go to `clock`.
/// @param kept interior DoFs whose rows of Psi are requested.
/// Throws NumericsError when K_ii is singular.
StaticPart static_part(const PartitionedModel& part, const std::vector<int32_t>& kept,
                       StepClock& clock);

}  // namespace clatter::condense
