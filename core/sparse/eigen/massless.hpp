#pragma once
// Unknowns without mass, condensed out where little is left.
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::sparse {

/// solve_modes by exact static condensation onto the unknowns m that have mass (Guyan 1965; exact,
/// since the others have no inertia):
///   (K_mm - K_m0 K_00^{-1} K_0m) x_m = lambda M_mm x_m,   x_0 = -K_00^{-1} K_0m x_m.
/// A Lanczos basis larger than the number of masses does not exist, so this is the way where they
/// are few. NotPositiveDefinite, with the column of K, when nothing holds the massless unknowns.
ModeSet solve_few_masses(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options);

}  // namespace clatter::sparse
