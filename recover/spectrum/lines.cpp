// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

/// Tolerance for a limit written with rounded digits.
constexpr double kSlack = 1.0 + 1e-9;

/// Peaks of the A-weighted power. Without the weighting rigid motion on the mounts would dominate.
std::vector<ChosenLine> strongest_peaks(const Eigen::VectorXd& frequency_hz,
                                        const Eigen::VectorXd& radiated, double from_hz,
                                        int count) {
  const Eigen::VectorXd power = radiated.cwiseProduct(frequency_hz.unaryExpr(&a_weighting_power));
  std::vector<ChosenLine> peaks;
  const Eigen::Index n = power.size();
  for (Eigen::Index k = 1; k < n; ++k) {
    const bool rises = power[k] > power[k - 1], falls = k + 1 == n || power[k] >= power[k + 1];
    if (rises && falls && frequency_hz[k] >= from_hz) peaks.push_back({k, frequency_hz[k]});
  }
  std::sort(peaks.begin(), peaks.end(), [&](const ChosenLine& a, const ChosenLine& b) {
    return power[a.index] != power[b.index] ? power[a.index] > power[b.index] : a.index < b.index;
  });
  peaks.resize(std::min(peaks.size(), static_cast<size_t>(count)));
  return peaks;
}

/// Lines with the frequency 0 are a mean, not a motion.
std::vector<ChosenLine> lines_between(const Eigen::VectorXd& frequency_hz, double from_hz,
                                      double to_hz) {
  std::vector<ChosenLine> lines;
  for (Eigen::Index k = 1; k < frequency_hz.size(); ++k)
    if (frequency_hz[k] * kSlack >= from_hz && frequency_hz[k] <= to_hz * kSlack)
      lines.push_back({k, frequency_hz[k]});
  if (lines.empty())
    throw InputError(
        fmt::format("lines: no line of the spectrum lies from {:g} to {:g} Hz: lines are {:g} Hz "
                    "apart",
                    from_hz, to_hz, frequency_hz[1] - frequency_hz[0]));
  return lines;
}

}  // namespace

FrequencyLimit frequency_limit(const SpectrumBand& requested, double valid_to_hz, double step_s) {
  const double nyquist = 0.5 / step_s;
  FrequencyLimit limit{nyquist, "half the sampling frequency of the run"};
  if (valid_to_hz > 0.0 && valid_to_hz < nyquist)
    limit = {valid_to_hz, "as far as the reduced basis holds"};
  if (requested.to_hz > limit.to_hz * kSlack)
    throw InputError(fmt::format("spectrum.to_hz: found {:g} Hz, expected at most {:g} Hz, {}",
                                 requested.to_hz, limit.to_hz, limit.reason));
  if (requested.to_hz > 0.0 && requested.to_hz < limit.to_hz)
    limit = {requested.to_hz, "as spectrum.to_hz says"};
  return limit;
}

std::vector<ChosenLine> choose_lines(const LineRule& rule, const SpectrumBand& band,
                                     const Analysis& analysis, const Eigen::VectorXd& power,
                                     const FrequencyLimit& limit) {
  const Eigen::VectorXd& frequency_hz = analysis.velocity.frequency_hz;
  if (frequency_hz.size() < 2) return {};
  if (!rule.orders.empty() && analysis.speed_hz == 0.0)
    throw InputError("lines.orders need a run with a crank angle: give frequencies_hz");
  std::vector<double> requested_hz = rule.frequencies_hz;
  for (double order : rule.orders) requested_hz.push_back(order * analysis.speed_hz);

  const auto refuse_beyond = [&](double f) {
    if (f > limit.to_hz * kSlack)
      throw InputError(fmt::format("lines: found {:g} Hz, expected at most {:g} Hz, {}", f,
                                   limit.to_hz, limit.reason));
  };
  std::vector<ChosenLine> lines;
  if (rule.from_hz) {
    refuse_beyond(*rule.to_hz);
    lines = lines_between(frequency_hz, *rule.from_hz, *rule.to_hz);
  }
  for (double f : requested_hz) {
    refuse_beyond(f);
    const Eigen::Index nearest = std::lround(f / analysis.velocity.spacing_hz());
    lines.push_back({std::clamp<Eigen::Index>(nearest, 1, frequency_hz.size() - 1), f});
  }
  if (!rule.requested()) lines = strongest_peaks(frequency_hz, power, band.from_hz, rule.strongest);
  std::sort(lines.begin(), lines.end(),
            [](const ChosenLine& a, const ChosenLine& b) { return a.index < b.index; });
  const auto same = [](const ChosenLine& a, const ChosenLine& b) { return a.index == b.index; };
  lines.erase(std::unique(lines.begin(), lines.end(), same), lines.end());
  return lines;
}

}  // namespace clatter::recover
