// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Static condensation of massless DoFs where few masses remain.
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::sparse {

/// solve_modes by exact static condensation onto the DoFs m that have mass (Guyan 1965; exact,
/// since the others have no inertia):
///   (K_mm - K_m0 K_00^{-1} K_0m) x_m = lambda M_mm x_m,   x_0 = -K_00^{-1} K_0m x_m.
/// A Lanczos basis cannot be larger than the number of masses, so this is used where they are few.
/// NotPositiveDefinite, with the column of K, when massless DoFs are unsupported.
ModeSet solve_few_masses(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options);

}  // namespace clatter::sparse
