// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/banded_lu.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::film {
namespace {

// target[0..kCount) -= sum over m of factor[m] * source row m; rows lie `stride` apart.
template <int kCount>
void subtract_rows(double* target, const double* factor, const double* source, int rows,
                   int stride) {
  double sum[kCount] = {};
  for (int m = 0; m < rows; ++m, source += stride)
    for (int c = 0; c < kCount; ++c) sum[c] += factor[m] * source[c];
  for (int c = 0; c < kCount; ++c) target[c] -= sum[c];
}

}  // namespace

BandedLu::BandedLu(int n, int band)
    : n_(n),
      band_(band),
      width_(static_cast<size_t>(2 * band + 1)),
      data_(static_cast<size_t>(n) * width_),
      inverse_(static_cast<size_t>(n)) {}

void BandedLu::set_zero() { std::fill(data_.begin(), data_.end(), 0.0); }

bool BandedLu::factor() {
  for (int k = 0; k < n_; ++k) {
    double* pivot_row = &at(k, k);
    const double inverse = 1.0 / *pivot_row;
    if (!std::isfinite(inverse)) return false;
    inverse_[k] = inverse;
    const int last = std::min(k + band_, n_ - 1);
    const int count = last - k;
    for (int i = k + 1; i <= last; ++i) {
      double* target = &at(i, k);
      if (*target == 0.0) continue;
      const double factor = *target * inverse;
      *target = factor;
      for (int c = 1; c <= count; ++c) target[c] -= factor * pivot_row[c];
    }
  }
  return true;
}

void BandedLu::solve(double* x) const {
  for (int i = 0; i < n_; ++i) {
    const int first = std::max(0, i - band_);
    const double* factor = row(i) + (first - i + band_);
    double sum = 0.0;
    for (int k = first; k < i; ++k) sum += factor[k - first] * x[k];
    x[i] -= sum;
  }
  for (int i = n_ - 1; i >= 0; --i) {
    const int last = std::min(n_ - 1, i + band_);
    const double* factor = row(i) + band_ + 1;
    double sum = 0.0;
    for (int k = i + 1; k <= last; ++k) sum += factor[k - i - 1] * x[k];
    x[i] = (x[i] - sum) * inverse_[i];
  }
}

// A strip of kCount columns: its part of a row stays in registers while the row's factors are
// applied.
template <int kCount>
void BandedLu::sweep_strip(double* x, int stride) const {
  for (int i = 1; i < n_; ++i) {
    const int first = std::max(0, i - band_);
    subtract_rows<kCount>(x + static_cast<ptrdiff_t>(i) * stride, row(i) + (first - i + band_),
                          x + static_cast<ptrdiff_t>(first) * stride, i - first, stride);
  }
  for (int i = n_ - 1; i >= 0; --i) {
    const int last = std::min(n_ - 1, i + band_);
    double* target = x + static_cast<ptrdiff_t>(i) * stride;
    subtract_rows<kCount>(target, row(i) + band_ + 1, target + stride, last - i, stride);
    for (int c = 0; c < kCount; ++c) target[c] *= inverse_[i];
  }
}

void BandedLu::solve_rows(double* x, int k) const {
  int begin = 0;
  for (; begin + 32 <= k; begin += 32) sweep_strip<32>(x + begin, k);
  for (; begin + 8 <= k; begin += 8) sweep_strip<8>(x + begin, k);
}

}  // namespace clatter::film
