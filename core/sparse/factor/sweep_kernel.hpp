// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inner loops of triangular solves with many right-hand sides, in registers: BLAS packs a panel for
// every product, which costs as much as the product for only some tens of columns.
#include <cstdint>

namespace clatter::sparse {

/// Right-hand sides processed together in registers.
inline constexpr int kLanes = 8;

/// Rows of kLanes values at distance `stride`.
struct Lanes {
  double* at = nullptr;
  int64_t stride = 0;
  Lanes row(int64_t i) const { return {at + i * stride, stride}; }
};

/// y(r) -= sum_j A(r, j) x(j); A is rows x columns, column-major with distance `stride`.
void subtract_product(const double* A, int64_t stride, int rows, int columns, Lanes x, Lanes y);

/// x(j) -= sum_r A(r, j) y(r).
void subtract_transposed(const double* A, int64_t stride, int rows, int columns, Lanes y, Lanes x);

/// x <- L^{-1} x and x <- L^{-T} x with the lower triangle of an n x n block.
void solve_lower(const double* L, int64_t stride, int n, Lanes x);
void solve_lower_transposed(const double* L, int64_t stride, int n, Lanes x);

}  // namespace clatter::sparse
