#pragma once
// How many eigenvalues lie below a limit: the proof that no mode was missed.
#include <cstdint>
#include <vector>

#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// What the count found and what it cost.
struct InertiaCount {
  int64_t negative = 0;   // eigenvalues of K x = lambda M x below mu
  int64_t zero = 0;       // pivots that vanish: mu is an eigenvalue to working precision
  double growth = 0.0;    // largest of all fronts (PivotSigns)
  bool by_mumps = false;  // the count is that of MUMPS
  double seconds = 0.0;
};

/// Number of negative pivots of K - mu M = L D L^T, which by Sylvester's law of inertia is the
/// number of eigenvalues of K x = lambda M x below mu when M is positive definite (Parlett, The
/// Symmetric Eigenvalue Problem, 1998, section 3.3). Multifrontal, nothing is kept; fronts whose
/// pivots are definite, nearly all below the first modes, cost what Cholesky costs, the others are
/// pivoted within their pivot block (eliminate_symmetric). A block, definite or
/// not, may stand near singularity, and rounding then grows with the square of PivotSigns::growth:
/// beyond 1e3 (perturbations of 2e-10 of a matrix with unit diagonal), MUMPS counts.
/// @param K, M [N/m], [kg], n x n, symmetric, lower triangle.
/// @param mu [rad2/s2]; should lie well inside a gap between eigenvalues.
/// @param permutation fill-reducing order (row of K at each place), may be empty.
/// Throws NumericsError when the factorisation fails.
InertiaCount count_below(const SparseMatrix& K, const SparseMatrix& M, double mu,
                         const std::vector<int64_t>& permutation = {});

}  // namespace clatter::sparse
