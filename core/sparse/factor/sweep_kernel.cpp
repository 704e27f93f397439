// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/sweep_kernel.hpp"

#include <algorithm>
#include <type_traits>

#include "core/base/each_cpu.hpp"

namespace clatter::sparse {
namespace {

/// kLanes doubles; the compiler splits them where registers are narrower. Never passed to a
/// function, since the CPU-specific clones below use different registers.
using Vector __attribute__((aligned(8), may_alias)) =
    double __attribute__((vector_size(kLanes * sizeof(double))));

// Accumulators that fit into registers; two products per cycle with latency four need at least
// eight.
#ifdef __AVX512F__
constexpr int kRegisterRows = 12;
#else
constexpr int kRegisterRows = 6;
#endif

#define CLATTER_INLINE inline __attribute__((always_inline))

// Row i of the lanes. A macro, because clang forgets the alignment of 8 in a reference that a
// function returns, and then requires that of the registers.
#define CLATTER_VECTOR_AT(lanes, i) \
  (*reinterpret_cast<Vector*>((lanes).at + static_cast<int64_t>(i) * (lanes).stride))

/// R rows of y.
template <int R>
CLATTER_INLINE void product_rows(const double* A, int64_t stride, int columns, const Lanes& x,
                                 const Lanes& y) {
  Vector sum[R];
  for (int r = 0; r < R; ++r) sum[r] = CLATTER_VECTOR_AT(y, r);
  for (int j = 0; j < columns; ++j) {
    const Vector xj = CLATTER_VECTOR_AT(x, j);
    const double* a = A + j * stride;
    for (int r = 0; r < R; ++r) sum[r] -= a[r] * xj;
  }
  for (int r = 0; r < R; ++r) CLATTER_VECTOR_AT(y, r) = sum[r];
}

/// R rows of x.
template <int R>
CLATTER_INLINE void transposed_rows(const double* A, int64_t stride, int rows, const Lanes& y,
                                    const Lanes& x) {
  Vector sum[R];
  for (int j = 0; j < R; ++j) sum[j] = CLATTER_VECTOR_AT(x, j);
  for (int r = 0; r < rows; ++r) {
    const Vector yr = CLATTER_VECTOR_AT(y, r);
    for (int j = 0; j < R; ++j) sum[j] -= A[r + j * stride] * yr;
  }
  for (int j = 0; j < R; ++j) CLATTER_VECTOR_AT(x, j) = sum[j];
}

/// body(constant of value `count`) for count <= Most, nothing for 0: the remaining rows in one go.
/// A single row would always wait for its previous product.
template <int Most, class Body>
CLATTER_INLINE void with_count(int count, Body&& body) {
  if constexpr (Most > 0) {
    if (count == Most) return body(std::integral_constant<int, Most>());
    with_count<Most - 1>(count, body);
  }
}

CLATTER_INLINE void product(const double* A, int64_t stride, int rows, int columns, const Lanes& x,
                            const Lanes& y) {
  int r = 0;
  for (; r + kRegisterRows <= rows; r += kRegisterRows)
    product_rows<kRegisterRows>(A + r, stride, columns, x, y.row(r));
  with_count<kRegisterRows - 1>(
      rows - r, [&](auto left) __attribute__((always_inline)) {
        product_rows<left()>(A + r, stride, columns, x, y.row(r));
      });
}

CLATTER_INLINE void transposed(const double* A, int64_t stride, int rows, int columns,
                               const Lanes& y, const Lanes& x) {
  int j = 0;
  for (; j + kRegisterRows <= columns; j += kRegisterRows)
    transposed_rows<kRegisterRows>(A + j * stride, stride, rows, y, x.row(j));
  with_count<kRegisterRows - 1>(
      columns - j, [&](auto left) __attribute__((always_inline)) {
        transposed_rows<left()>(A + j * stride, stride, rows, y, x.row(j));
      });
}

}  // namespace

CLATTER_EACH_CPU void subtract_product(const double* A, int64_t stride, int rows, int columns,
                                       Lanes x, Lanes y) {
  product(A, stride, rows, columns, x, y);
}

CLATTER_EACH_CPU void subtract_transposed(const double* A, int64_t stride, int rows, int columns,
                                          Lanes y, Lanes x) {
  transposed(A, stride, rows, columns, y, x);
}

CLATTER_EACH_CPU void solve_lower(const double* L, int64_t stride, int n, Lanes x) {
  for (int begin = 0; begin < n; begin += kRegisterRows) {
    const int end = std::min(n, begin + kRegisterRows);
    for (int j = begin; j < end; ++j) {
      const double* column = L + j * stride;
      const Vector xj = CLATTER_VECTOR_AT(x, j) * (1.0 / column[j]);
      CLATTER_VECTOR_AT(x, j) = xj;
      for (int r = j + 1; r < end; ++r) CLATTER_VECTOR_AT(x, r) -= column[r] * xj;
    }
    product(L + begin * stride + end, stride, n - end, end - begin, x.row(begin), x.row(end));
  }
}

CLATTER_EACH_CPU void solve_lower_transposed(const double* L, int64_t stride, int n, Lanes x) {
  for (int begin = (n - 1) / kRegisterRows * kRegisterRows; begin >= 0; begin -= kRegisterRows) {
    const int end = std::min(n, begin + kRegisterRows);
    transposed(L + begin * stride + end, stride, n - end, end - begin, x.row(end), x.row(begin));
    for (int j = end - 1; j >= begin; --j) {
      const double* column = L + j * stride;
      Vector sum = CLATTER_VECTOR_AT(x, j);
      for (int r = j + 1; r < end; ++r) sum -= column[r] * CLATTER_VECTOR_AT(x, r);
      CLATTER_VECTOR_AT(x, j) = sum * (1.0 / column[j]);
    }
  }
}

}  // namespace clatter::sparse
