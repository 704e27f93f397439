// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/run/resample.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/base/threads.hpp"

namespace clatter::recover {
namespace {

constexpr double kKaiserBeta = 12.265;
constexpr int kTaps = 2 * kHalfWidth;

/// Weights of the samples first .. first + kTaps - 1 for a position `at` samples after the first.
std::array<double, kTaps> weights(double at) {
  std::array<double, kTaps> h{};
  double sum = 0.0;
  for (int k = 0; k < kTaps; ++k) {
    const double x = at - k, edge = x / kHalfWidth, pi_x = std::numbers::pi * x;
    const double sinc = std::abs(pi_x) < 1e-9 ? 1.0 : std::sin(pi_x) / pi_x;
    h[k] = sinc * std::cyl_bessel_i(0.0, kKaiserBeta * std::sqrt(std::max(1.0 - edge * edge, 0.0)));
    sum += h[k];
  }
  for (double& value : h) value /= sum;
  return h;
}

}  // namespace

RowMatrix resample(const RowMatrix& samples, const Eigen::VectorXd& positions) {
  RowMatrix values(positions.size(), samples.cols());
  parallel_pieces(positions.size(), [&](int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end; ++i) {
      const int64_t first = static_cast<int64_t>(std::floor(positions[i])) - kHalfWidth + 1;
      assert(first >= 0 && first + kTaps <= samples.rows());
      const std::array<double, kTaps> h = weights(positions[i] - static_cast<double>(first));
      values.row(i).noalias() =
          Eigen::Map<const Eigen::RowVectorXd>(h.data(), kTaps) * samples.middleRows(first, kTaps);
    }
  });
  return values;
}

double interpolate(const Eigen::VectorXd& x_i, const Eigen::VectorXd& y_i, double x) {
  constexpr Eigen::Index kPoints = 6;
  const Eigen::Index n = std::min<Eigen::Index>(kPoints, x_i.size());
  const Eigen::Index above = std::lower_bound(x_i.begin(), x_i.end(), x) - x_i.begin();
  const Eigen::Index first = std::clamp<Eigen::Index>(above - n / 2, 0, x_i.size() - n);
  std::array<double, kPoints> p{};
  for (Eigen::Index i = 0; i < n; ++i) p[i] = y_i[first + i];
  for (Eigen::Index m = 1; m < n; ++m)
    for (Eigen::Index i = 0; i + m < n; ++i) {
      const double left = x_i[first + i], right = x_i[first + i + m];
      double& at = p[i];
      at = ((x - right) * at + (left - x) * p[i + 1]) / (left - right);
    }
  return p[0];
}

}  // namespace clatter::recover
