// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A small banded LU for the film matrices.
#include <cstddef>
#include <vector>

namespace clatter::film {

/// LU of a banded matrix with b sub- and b superdiagonals, without pivoting.
///
/// The film matrix is an M-matrix, diagonally dominant by columns in either state of a cell (see
/// reynolds.hpp): then LU without row exchange is stable, growth factor at most 2 (Higham 2002,
/// Accuracy and Stability of Numerical Algorithms, theorem 9.9), and it commutes with scaling.
class BandedLu {
 public:
  BandedLu() = default;
  BandedLu(int n, int band);

  int size() const { return n_; }
  int band() const { return band_; }
  void set_zero();
  /// Entry (i, j), |i - j| <= band; valid before `factor`.
  double& at(int i, int j) {
    return data_[static_cast<size_t>(i) * width_ + static_cast<size_t>(j - i + band_)];
  }

  /// Factors in place; false when a pivot is zero or not finite.
  [[nodiscard]] bool factor();
  /// x <- A^-1 x for one right-hand side, n.
  void solve(double* x) const;
  /// X <- A^-1 X for k right-hand sides, n x k stored row by row; k must be a multiple of 8, see
  /// `padded`.
  void solve_rows(double* x, int k) const;

  /// Columns to provide for k right-hand sides.
  static int padded(int k) { return (k + 7) / 8 * 8; }

 private:
  template <int kCount>
  void sweep_strip(double* x, int stride) const;
  const double* row(int i) const { return data_.data() + static_cast<size_t>(i) * width_; }
  int n_ = 0, band_ = 0;
  size_t width_ = 1;
  std::vector<double> data_;     // row-major band, diagonal in column band_
  std::vector<double> inverse_;  // reciprocal pivots
};

}  // namespace clatter::film
