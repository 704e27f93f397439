// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Dense elimination of the columns of one front.
#include <cstdint>
#include <vector>

namespace clatter::sparse {

/// The lower trapezoid of a front: `columns` pivots above `below` rows, and the square update
/// matrix of these rows. Column-major; `panel` has columns + below rows.
struct Front {
  int columns = 0;
  int below = 0;
  double* panel = nullptr;   // (columns + below) x columns
  double* update = nullptr;  // below x below, lower triangle
  int height() const { return columns + below; }
};

/// Cholesky of the pivots, L21 = A21 L11^{-T}, update -= L21 L21^T. Returns 0, or 1 + the pivot
/// where the matrix is found not to be positive definite.
int eliminate_definite(const Front& front);

/// Signs of the pivots of a symmetric front.
struct PivotSigns {
  int64_t negative = 0;
  int64_t zero = 0;  // pivots below 1e-15 for a matrix with unit diagonal
  /// The rounding error of the update grows with its square: max |A11^{-1} A12| where A11 was
  /// indefinite, sqrt(max (L21 L21^T)_ii) where it was definite.
  double growth = 0.0;
};

/// Cholesky where the pivot block is definite; else bounded Bunch-Kaufman within it (Ashcraft,
/// Grimes and Lewis 1998; LAPACK's dsytrf_rk) and update -= A21 A11^{-1} A12. The panel is
/// destroyed.
PivotSigns eliminate_symmetric(const Front& front);

}  // namespace clatter::sparse
