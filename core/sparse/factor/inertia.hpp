// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Counts the eigenvalues below a limit, as proof that no mode was missed.
#include <cstdint>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// Result and cost of the count.
struct InertiaCount {
  int64_t negative = 0;   // eigenvalues of K x = lambda M x below mu
  int64_t zero = 0;       // zero pivots: mu is an eigenvalue to working precision
  double growth = 0.0;    // largest over all fronts (PivotSigns)
  bool by_mumps = false;  // counted by MUMPS
  double seconds = 0.0;
};

/// Number of negative pivots of K - mu M = L D L^T, which by Sylvester's law of inertia is the
/// number of eigenvalues of K x = lambda M x below mu when M is positive definite (Parlett, The
/// Symmetric Eigenvalue Problem, 1998, section 3.3). Multifrontal, the factor is not kept; fronts
/// with definite pivots, nearly all for low mu, use Cholesky, the others are pivoted within their
/// pivot block (eliminate_symmetric). A block, definite or not, may be nearly singular, and
/// rounding then grows with the square of PivotSigns::growth: beyond 1e3 (perturbations of 2e-10 of
/// a matrix with unit diagonal), MUMPS counts instead.
/// @param K, M [N/m], [kg], n x n, symmetric, lower triangle.
/// @param mu [rad2/s2]; should lie well within a gap between eigenvalues.
/// @param permutation fill-reducing permutation (row of K at each index), may be empty.
/// Throws NumericsError when the factorisation fails.
InertiaCount count_below(const SparseMatrix& K, const SparseMatrix& M, double mu,
                         const std::vector<int64_t>& permutation = {});

}  // namespace clatter::sparse
