// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The same count by MUMPS (Amestoy, Duff, L'Excellent and Koster 2001): used where our own pivots
// are too small, and as reference in tests.
#include "core/sparse/factor/inertia.hpp"

namespace clatter::sparse {

/// count_below by MUMPS's LDL^T, whose pivots may be delayed to the parent front; the factor is not
/// kept. Throws NumericsError when the factorisation fails.
InertiaCount count_below_by_mumps(const SparseMatrix& K, const SparseMatrix& M, double mu,
                                  const std::vector<int64_t>& permutation = {});

}  // namespace clatter::sparse
