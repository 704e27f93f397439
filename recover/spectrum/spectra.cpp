// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/spectra.hpp"

#include <cmath>
#include <numbers>

#include "core/base/threads.hpp"
#include "recover/spectrum/fft.hpp"

namespace clatter::recover {

LineSpectrum line_spectrum(const Piece& piece, const RowMatrix& samples, double to_hz) {
  const int64_t n = piece.count;
  const double spacing = 1.0 / piece.duration_s();
  const int64_t lines =
      std::min<int64_t>(n / 2, static_cast<int64_t>(std::floor(to_hz / spacing + 1e-6))) + 1;
  const Eigen::VectorXd taper = taper_values(piece.taper, n);
  const double gain = taper.mean();
  const double noise_bandwidth = taper.squaredNorm() / (static_cast<double>(n) * gain * gain);

  LineSpectrum spectrum;
  spectrum.periodic = piece.periodic;
  spectrum.frequency_hz =
      Eigen::VectorXd::LinSpaced(lines, 0.0, static_cast<double>(lines - 1) * spacing);
  spectrum.power_factor = Eigen::VectorXd::Constant(lines, 0.5 / noise_bandwidth);
  Eigen::VectorXd one_sided = Eigen::VectorXd::Constant(lines, 2.0);
  const auto stands_alone = [&](int64_t k) { return k == 0 || 2 * k == n; };
  for (int64_t k : {int64_t{0}, lines - 1})
    if (stands_alone(k)) {
      one_sided[k] = 1.0;
      spectrum.power_factor[k] = 1.0 / noise_bandwidth;
    }

  // The first sample is start_s after the time origin of phases.
  const double start_s = piece.start_s();
  Eigen::VectorXcd scale(lines);
  for (int64_t k = 0; k < lines; ++k)
    scale[k] = one_sided[k] / (static_cast<double>(n) * gain) *
               std::polar(1.0, -2 * std::numbers::pi * spectrum.frequency_hz[k] * start_s);

  spectrum.amplitude.resize(lines, samples.cols());
  parallel_pieces(samples.cols(), [&](int64_t begin, int64_t end) {
    for (int64_t c = begin; c < end; ++c) {
      Eigen::VectorXd x = samples.col(c);
      if (!piece.periodic) x.array() -= x.dot(taper) / taper.sum();
      spectrum.amplitude.col(c) = real_fft(x.cwiseProduct(taper)).head(lines).cwiseProduct(scale);
    }
  });
  return spectrum;
}

}  // namespace clatter::recover
