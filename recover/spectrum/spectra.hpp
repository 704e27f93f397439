// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Line spectra of a piece of a run.
//
// Convention: x(t) = X_0 + sum_k Re( X_k exp(+i 2 pi f_k t) ), peak amplitudes, t = 0 at firing
// TDC.
#include <Eigen/Core>

#include "recover/options/piece.hpp"

namespace clatter::recover {

struct LineSpectrum {
  Eigen::VectorXd frequency_hz;  // n_l, f_k = k / duration, from 0
  Eigen::MatrixXcd amplitude;    // n_l x columns, peak, unit of the samples
  /// n_l: mean square = sum_k power_factor_k |X_k|^2. 1/2 for a tone, 1 at 0 Hz and at the Nyquist
  /// line; divided by the taper's equivalent noise bandwidth, so that sums over lines equal the
  /// mean square of the (tapered) piece.
  Eigen::VectorXd power_factor;
  bool periodic = false;
  double spacing_hz() const { return frequency_hz.size() > 1 ? frequency_hz[1] : 0.0; }
};

/// Transforms each column of `samples` (count x columns, rows = the piece's samples), lines up to
/// `to_hz` (that line included).
///
/// Over one cycle a plain transform is exact: lines are 1/2 engine order apart, without leakage.
/// For other pieces the mean is removed (line 0 is then zero) and a taper applied; amplitudes are
/// divided by the taper's mean, so a tone inside a window has its true amplitude.
LineSpectrum line_spectrum(const Piece& piece, const RowMatrix& samples, double to_hz);

}  // namespace clatter::recover
