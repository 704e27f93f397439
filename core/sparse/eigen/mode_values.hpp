// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Conversion of eigenvalues and frequencies, and a default shift.
#include "core/base/sparse.hpp"

namespace clatter::sparse {

/// lambda of a frequency: (2 pi f)^2.
double value_of_hz(double hz);
double hz_of_value(double value);

/// A negative shift of about a tenth of the first elastic eigenvalue of a compact body, from the
/// median of K_jj / M_jj (the square of the highest frequency of an element) and the number of
/// unknowns. The quality of the guess affects only the speed.
double default_shift(const SparseMatrix& K, const SparseMatrix& M);

}  // namespace clatter::sparse
