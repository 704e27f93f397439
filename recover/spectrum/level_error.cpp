// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/level_error.hpp"

#include <cmath>
#include <numbers>

#include "recover/spectrum/levels.hpp"

namespace clatter::recover {

std::optional<double> level_error_db(const std::vector<double>& powers, double averages) {
  const Eigen::Map<const Eigen::ArrayXd> P(powers.data(), std::ssize(powers));
  if (P.size() < 2 || !(averages > 1.0) || !(P.mean() > 0.0)) return std::nullopt;
  const double s = std::sqrt((P - P.mean()).square().mean() / (averages - 1.0));
  return 10.0 / std::numbers::ln10 * s / P.mean();
}

void SegmentTotals::add(const Eigen::VectorXd& frequency_hz, const Eigen::VectorXd& power) {
  double plain = 0.0, weighted = 0.0;
  for (Eigen::Index k = 0; k < power.size(); ++k) {
    if (frequency_hz[k] < from_hz_) continue;
    plain += power[k];
    weighted += a_weighting_power(frequency_hz[k]) * power[k];
  }
  plain_.push_back(plain);
  weighted_.push_back(weighted);
}

}  // namespace clatter::recover
