// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The Craig-Bampton basis: constraint modes and fixed-interface modes from one factorisation.
#include <memory>
#include <string>
#include <vector>

#include "condense/basis/interior_modes.hpp"
#include "condense/basis/residual_modes.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/free_motions.hpp"
#include "core/rom/elimination_order.hpp"

namespace clatter::condense {

/// The basis V = [I 0; Psi_ib Phi_ik], its matrices and the checks made.
struct CraigBampton : Reduction {
  Eigen::VectorXd fixed_interface_hz;  // of the kept shapes: modes, load shapes, residual modes
  InteriorModes interior;              // their data; the vectors were moved to the basis
  ResidualReport residual;
  sparse::FactorReport factor;
  double rigid_error = 0.0;  // of the static shapes
};

/// Results for a boundary that do not depend on the modes added.
struct StaticPart {
  std::shared_ptr<const sparse::Factor> factor_ii;
  StaticReduction reduction;
  rom::EliminationOrder order;  // of K_ii
};

/// Factorises K_ii and reduces statically (Guyan 1965). Steps go to `clock`.
/// @param kept interior DoFs whose rows of Psi are requested.
/// @param order reused when it fits K_ii (hard case C7), instead of computing one.
/// Throws NumericsError when K_ii is singular.
StaticPart static_part(const PartitionedModel& part, const std::vector<int32_t>& kept,
                       StepClock& clock, const rom::EliminationOrder& order = {});

/// Basis of Craig and Bampton (1968): Psi_ib = -K_ii^{-1} K_ib with the shapes Phi_ik of
/// interior_modes.hpp. One factorisation of K_ii serves both. Without modes (`request` empty) it is
/// Guyan's, and the cut-off is the first fixed-interface frequency, above which the basis has no
/// modes. Throws NumericsError as solve_modes does.
CraigBampton craig_bampton(const PartitionedModel& part, const StaticPart& statics,
                           const ModeRequest& request, StepClock& clock);

}  // namespace clatter::condense
