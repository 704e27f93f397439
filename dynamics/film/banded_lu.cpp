#include "dynamics/film/banded_lu.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::film {
namespace {

// Right-hand sides are swept in strips of this many columns: one strip of a row stays in registers.
constexpr int kStrip = 16;

// target[0..count) -= sum over m of factor[m] * source row m; rows lie `stride` apart.
void subtract_rows(double* target, const double* factor, const double* source, int rows, int stride,
                   int count) {
  if (count == kStrip) {
    double sum[kStrip] = {};
    for (int m = 0; m < rows; ++m, source += stride)
      for (int c = 0; c < kStrip; ++c) sum[c] += factor[m] * source[c];
    for (int c = 0; c < kStrip; ++c) target[c] -= sum[c];
    return;
  }
  for (int m = 0; m < rows; ++m, source += stride)
    for (int c = 0; c < count; ++c) target[c] -= factor[m] * source[c];
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
    inverse_[static_cast<size_t>(k)] = inverse;
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
    x[i] = (x[i] - sum) * inverse_[static_cast<size_t>(i)];
  }
}

void BandedLu::solve_rows(double* x, int k) const {
  for (int begin = 0; begin < k; begin += kStrip) {
    const int count = std::min(kStrip, k - begin);
    double* strip = x + begin;
    for (int i = 1; i < n_; ++i) {
      const int first = std::max(0, i - band_);
      subtract_rows(strip + static_cast<ptrdiff_t>(i) * k, row(i) + (first - i + band_),
                    strip + static_cast<ptrdiff_t>(first) * k, i - first, k, count);
    }
    for (int i = n_ - 1; i >= 0; --i) {
      const int last = std::min(n_ - 1, i + band_);
      double* target = strip + static_cast<ptrdiff_t>(i) * k;
      if (last > i) subtract_rows(target, row(i) + band_ + 1, target + k, last - i, k, count);
      for (int c = 0; c < count; ++c) target[c] *= inverse_[static_cast<size_t>(i)];
    }
  }
}

}  // namespace clatter::film
