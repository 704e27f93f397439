// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The fast Fourier transform (Eigen's unsupported FFT, which wraps kissfft), used only here.
#include <Eigen/Core>
#include <complex>

namespace clatter::recover {

/// One-sided transform of a real sequence: X_k = sum_n x_n exp(-2 pi i k n / N), k = 0 .. N/2.
/// No scaling. Any N >= 1; fastest when N is a product of 2, 3 and 5.
Eigen::VectorXcd real_fft(const Eigen::VectorXd& x);

}  // namespace clatter::recover
