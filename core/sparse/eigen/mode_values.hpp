#pragma once
// Eigenvalues and frequencies, and where to look for the lowest.
#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// lambda of a frequency: (2 pi f)^2.
double value_of_hz(double hz);
double hz_of_value(double value);

/// A negative shift of the size of a tenth of the first elastic eigenvalue of a compact body, from
/// the median of K_jj / M_jj (the square of the highest frequency of an element) and the number of
/// unknowns. Only speed depends on how good the guess is.
double default_shift(const SparseMatrix& K, const SparseMatrix& M);

}  // namespace clatter::sparse
