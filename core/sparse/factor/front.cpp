// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/front.hpp"

#include <cblas.h>
#include <lapack.h>

#include <algorithm>
#include <cmath>

namespace clatter::sparse {
namespace {

constexpr double kZeroPivot = 1e-15;
constexpr int kStripe = 192;  // columns of the update per matrix product

int cholesky(int n, double* a, int stride) {
  int info = 0;
  LAPACK_dpotrf("L", &n, a, &stride, &info);
  return info;
}

void update_definite(const Front& front) {
  if (front.below == 0) return;
  double* below = front.panel + front.columns;
  cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, front.below,
              front.columns, 1.0, front.panel, front.height(), below, front.height());
  cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, front.below, front.columns, -1.0, below,
              front.height(), 1.0, front.update, front.below);
}

/// The pivot block, saved in case Cholesky fails.
std::vector<double> pivot_block(const Front& front) {
  const auto p = static_cast<size_t>(front.columns), h = static_cast<size_t>(front.height());
  std::vector<double> block(p * p);
  for (size_t j = 0; j < p; ++j)
    std::copy(front.panel + j * h + j, front.panel + j * h + p, block.data() + j * p + j);
  return block;
}

void put_back(const std::vector<double>& block, const Front& front) {
  const auto p = static_cast<size_t>(front.columns), h = static_cast<size_t>(front.height());
  for (size_t j = 0; j < p; ++j)
    std::copy(block.data() + j * p + j, block.data() + (j + 1) * p, front.panel + j * h + j);
}

struct BlockDiagonal {
  std::vector<double> subdiagonal;  // of D
  std::vector<int> pivots;
};

BlockDiagonal bunch_kaufman(const Front& front) {
  BlockDiagonal d;
  d.subdiagonal.resize(front.columns);
  d.pivots.resize(front.columns);
  const int n = front.columns, stride = front.height(), query = -1;
  double best = 0.0;
  int info = 0;
  LAPACK_dsytrf_rk("L", &n, front.panel, &stride, d.subdiagonal.data(), d.pivots.data(), &best,
                   &query, &info);
  const int room = std::max(1, static_cast<int>(best));
  std::vector<double> work(static_cast<size_t>(room));
  LAPACK_dsytrf_rk("L", &n, front.panel, &stride, d.subdiagonal.data(), d.pivots.data(),
                   work.data(), &room, &info);
  return d;
}

/// sqrt(max (L21 L21^T)_ii): growth by Cholesky of the pivots for rows of unit size. At most about
/// one where the full matrix is definite; large where the pivot block is nearly singular.
double growth_definite(const Front& front) {
  std::vector<double> squares(static_cast<size_t>(front.below), 0.0);
  for (int j = 0; j < front.columns; ++j) {
    const double* column =
        front.panel + static_cast<size_t>(j) * static_cast<size_t>(front.height()) + front.columns;
    for (int i = 0; i < front.below; ++i) squares[i] += column[i] * column[i];
  }
  return front.below == 0 ? 0.0 : std::sqrt(*std::max_element(squares.begin(), squares.end()));
}

/// Signs of the blocks of D; the eigenvalues of a 2 x 2 block by its determinant and trace.
void count_signs(const Front& front, const BlockDiagonal& d, PivotSigns& signs) {
  const auto diagonal = [&](int j) {
    return front.panel[static_cast<size_t>(j) * static_cast<size_t>(front.height() + 1)];
  };
  for (int j = 0; j < front.columns; ++j) {
    const double a = diagonal(j), subdiagonal = d.subdiagonal[j];
    if (subdiagonal == 0.0) {
      signs.negative += a < -kZeroPivot;
      signs.zero += std::abs(a) <= kZeroPivot;
      continue;
    }
    const double b = diagonal(++j), determinant = a * b - subdiagonal * subdiagonal;
    signs.negative += determinant < 0.0 ? 1 : 2 * (a + b < 0.0);
  }
}

/// update -= A21 A11^{-1} A12, by stripes of its lower triangle; returns max |A11^{-1} A12|.
double update_indefinite(const Front& front, const BlockDiagonal& d) {
  const int p = front.columns, q = front.below, h = front.height();
  if (q == 0) return 0.0;
  double largest = 0.0;
  std::vector<double> x(static_cast<size_t>(p) * static_cast<size_t>(std::min(q, kStripe)));
  for (int begin = 0; begin < q; begin += kStripe) {
    const int width = std::min(kStripe, q - begin);
    for (int c = 0; c < width; ++c)
      for (int j = 0; j < p; ++j)
        x[static_cast<size_t>(c) * static_cast<size_t>(p) + static_cast<size_t>(j)] =
            front.panel[static_cast<size_t>(j) * static_cast<size_t>(h) +
                        static_cast<size_t>(p + begin + c)];
    int info = 0;
    LAPACK_dsytrs_3("L", &p, &width, front.panel, &h, d.subdiagonal.data(), d.pivots.data(),
                    x.data(), &p, &info);
    for (size_t k = 0; k < static_cast<size_t>(p) * static_cast<size_t>(width); ++k)
      largest = std::max(largest, std::abs(x[k]));
    double* corner = front.update + static_cast<size_t>(begin) * static_cast<size_t>(q + 1);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, q - begin, width, p, -1.0,
                front.panel + p + begin, h, x.data(), p, 1.0, corner, q);
  }
  return largest;
}

}  // namespace

int eliminate_definite(const Front& front) {
  const int failed = cholesky(front.columns, front.panel, front.height());
  if (failed == 0) update_definite(front);
  return failed;
}

PivotSigns eliminate_symmetric(const Front& front) {
  PivotSigns signs;
  const std::vector<double> block = pivot_block(front);
  if (cholesky(front.columns, front.panel, front.height()) == 0) {
    for (int j = 0; j < front.columns; ++j) {
      const double l =
          front.panel[static_cast<size_t>(j) * static_cast<size_t>(front.height() + 1)];
      signs.zero += l * l <= kZeroPivot;
    }
    update_definite(front);
    signs.growth = growth_definite(front);
    return signs;
  }
  put_back(block, front);
  const BlockDiagonal d = bunch_kaufman(front);
  count_signs(front, d, signs);
  if (signs.zero == 0) signs.growth = update_indefinite(front, d);
  return signs;
}

}  // namespace clatter::sparse
