// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/fft.hpp"

// Third-party code with narrowing conversions.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wextra"
#include <unsupported/Eigen/FFT>
#pragma GCC diagnostic pop

namespace clatter::recover {

Eigen::VectorXcd real_fft(const Eigen::VectorXd& x) {
  // The plan (twiddle factors) of a length is kept for the next column; one set per thread.
  thread_local Eigen::FFT<double> fft;
  const Eigen::Index n = x.size();
  Eigen::VectorXcd full(n);
  // The complex transform, since kissfft's real one handles only even lengths.
  const Eigen::VectorXcd z = x.cast<std::complex<double>>();
  if (n == 1)
    full = z;
  else
    fft.fwd(full.data(), z.data(), n);
  return full.head(n / 2 + 1);
}

}  // namespace clatter::recover
