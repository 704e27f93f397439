// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clatter::recover {

ThirdOctaves third_octaves(double from_hz, double to_hz, double line_spacing_hz) {
  const double half = std::pow(10.0, 0.05);
  // A band edge requested by its printed value must not be lost by rounding of its last digit.
  constexpr double kSlack = 1e-9;
  std::vector<double> mid;
  ThirdOctaves bands;
  for (int n = -30; n <= 30; ++n) {
    const double centre = 1000.0 * std::pow(10.0, n / 10.0);
    const double lower = centre / half, upper = centre * half;
    if (lower < from_hz * (1 - kSlack) || upper > to_hz * (1 + kSlack)) continue;
    if (upper - lower < line_spacing_hz) continue;
    mid.push_back(centre);
    bands.nominal.push_back(nominal_frequency(n));
  }
  bands.mid_hz =
      Eigen::Map<const Eigen::VectorXd>(mid.data(), static_cast<Eigen::Index>(mid.size()));
  bands.lower_hz = bands.mid_hz / half;
  bands.upper_hz = bands.mid_hz * half;
  return bands;
}

double covered_to_hz(const Eigen::VectorXd& frequency_hz, double to_hz, bool periodic) {
  const Eigen::Index n = frequency_hz.size();
  if (periodic || n < 2) return to_hz;
  return std::min(to_hz, frequency_hz[n - 1] + 0.5 * (frequency_hz[1] - frequency_hz[0]));
}

std::string nominal_frequency(int n) {
  static constexpr double kSteps[] = {1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0};
  const int decade = n >= 0 ? n / 10 : -((9 - n) / 10);
  return fmt::format("{:g}", kSteps[n - 10 * decade] * std::pow(10.0, 3 + decade));
}

Eigen::VectorXd band_sums(const Eigen::VectorXd& frequency_hz, const Eigen::VectorXd& power,
                          const ThirdOctaves& bands, bool periodic) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(bands.size());
  if (frequency_hz.size() < 2) return sums;
  const double spacing = frequency_hz[1] - frequency_hz[0];
  for (Eigen::Index k = 0; k < frequency_hz.size(); ++k)
    for (Eigen::Index b = 0; b < bands.size(); ++b) {
      const double f = frequency_hz[k];
      if (periodic) {
        if (f >= bands.lower_hz[b] && f < bands.upper_hz[b]) sums[b] += power[k];
        continue;
      }
      const double shared = std::min(f + spacing / 2, bands.upper_hz[b]) -
                            std::max(f - spacing / 2, bands.lower_hz[b]);
      if (shared > 0.0) sums[b] += power[k] * shared / spacing;
    }
  return sums;
}

double a_weighting_power(double frequency_hz) {
  const double f2 = frequency_hz * frequency_hz;
  constexpr double kHigh = 12194.217 * 12194.217;
  const double r =
      kHigh * f2 * f2 /
      ((f2 + 20.598997 * 20.598997) *
       std::sqrt((f2 + 107.65265 * 107.65265) * (f2 + 737.86223 * 737.86223)) * (f2 + kHigh));
  return r * r * std::pow(10.0, 0.2);
}

double a_weighting_db(double frequency_hz) {
  return 10.0 * std::log10(a_weighting_power(frequency_hz));
}

double level_db(double power, double reference) {
  return power > 0.0 ? std::max(10.0 * std::log10(power / reference), kSilence) : kSilence;
}

Eigen::VectorXd levels_db(const Eigen::VectorXd& power, double reference) {
  return power.unaryExpr([reference](double p) { return level_db(p, reference); });
}

}  // namespace clatter::recover
