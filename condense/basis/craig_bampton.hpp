// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The Craig-Bampton basis: constraint modes and fixed-interface modes from one factorisation.
#include <string>
#include <vector>

#include "condense/basis/interior_modes.hpp"
#include "condense/basis/residual_modes.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter::condense {

/// The basis V = [I 0; Psi_ib Phi_ik], its matrices and the checks made.
struct CraigBampton : Reduction {
  Eigen::VectorXd fixed_interface_hz;  // of the kept shapes: modes, load shapes, residual modes
  InteriorModes interior;              // their data; the vectors were moved to the basis
  ResidualReport residual;
  sparse::FactorReport factor;
  double rigid_error = 0.0;  // of the static shapes
  int dropped = 0;           // vectors that depended on others (hard case B3)
};

/// Basis of Craig and Bampton (1968): Psi_ib = -K_ii^{-1} K_ib with the shapes Phi_ik of
/// interior_modes.hpp. One factorisation of K_ii serves both. Without modes (`request` empty) it is
/// Guyan's, and the cut-off is the first fixed-interface frequency, above which the basis has no
/// modes. Throws NumericsError as solve_modes does.
CraigBampton craig_bampton(const PartitionedModel& part, const StaticPart& statics,
                           const ModeRequest& request, StepClock& clock);

/// Columns that do not depend on those before them: column j is kept when its remainder after
/// projection on the kept ones exceeds `tolerance` of its own M-norm squared (hard case B3).
/// The first `protected_count` columns are always kept. Ascending indices.
/// @param M_rr r x r, the columns' Gram matrix in the mass inner product.
std::vector<int> independent_columns(const Eigen::MatrixXd& M_rr, Eigen::Index protected_count,
                                     double tolerance = 1e-12);

}  // namespace clatter::condense
