// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/options/piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

constexpr double kCycle = 720.0;

/// Run time at which the crank is at `angle`; constant speed between samples.
double time_at_angle(const RunClock& clock, double angle) {
  return clock.time[0] + (angle - clock.angle_deg[0]) / clock.speed_deg_s();
}

/// Index of the first sample not before `value`, with a millionth of a step of tolerance.
int64_t first_at(const Eigen::VectorXd& axis, double value) {
  const double step = (axis[axis.size() - 1] - axis[0]) / static_cast<double>(axis.size() - 1);
  return std::lower_bound(axis.begin(), axis.end(), value - 1e-6 * step) - axis.begin();
}

}  // namespace

Taper taper_of(const std::string& name) {
  for (Taper taper : {Taper::kNone, Taper::kHann, Taper::kTukey, Taper::kFlatTop})
    if (name_of(taper) == name) return taper;
  throw InputError("taper: found '" + name + "', expected none, hann, tukey or flattop");
}

std::string name_of(Taper taper) {
  switch (taper) {
    case Taper::kNone:
      return "none";
    case Taper::kHann:
      return "hann";
    case Taper::kTukey:
      return "tukey";
    case Taper::kFlatTop:
      return "flattop";
  }
  return "none";
}

Eigen::VectorXd taper_values(Taper taper, int64_t count) {
  Eigen::VectorXd w(count);
  for (int64_t i = 0; i < count; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double phase = 2 * std::numbers::pi * x;
    constexpr double kFlank = 0.1;
    const double edge = std::min(x, 1.0 - x) / kFlank;
    switch (taper) {
      case Taper::kNone:
        w[i] = 1.0;
        break;
      case Taper::kHann:
        w[i] = 0.5 - 0.5 * std::cos(phase);
        break;
      case Taper::kTukey:
        w[i] = edge < 1.0 ? 0.5 - 0.5 * std::cos(std::numbers::pi * edge) : 1.0;
        break;
      case Taper::kFlatTop:  // ISO 18431-2, five terms
        w[i] = 1 - 1.933 * std::cos(phase) + 1.286 * std::cos(2 * phase) -
               0.388 * std::cos(3 * phase) + 0.0322 * std::cos(4 * phase);
        break;
    }
  }
  return w;
}

Piece last_cycle(const RunClock& clock, const std::string& origin) {
  if (!clock.has_crank())
    throw InputError(origin +
                     ": output/crank_angle_deg: found no crank rotation, expected complete cycles");
  const int64_t n_t = clock.time.size();
  const double steps = kCycle / (clock.speed_deg_s() * clock.step_s);
  const int64_t count = std::llround(steps);
  if (count > n_t)
    throw InputError(fmt::format(
        "{}: output/time: found {} samples, expected a complete cycle of {}", origin, n_t, count));
  // A remainder of a thousandth of a step is a phase error of 0.2 degrees at the Nyquist frequency.
  if (std::abs(steps - static_cast<double>(count)) > 1e-3)
    throw InputError(fmt::format(
        "{}: output/time: found {:.3f} steps per cycle, expected an integer (or `cycle = false`)",
        origin, steps));
  Piece piece{.name = "cycle", .count = count, .step_s = clock.step_s, .periodic = true};
  // The last sample repeats the one a cycle earlier and is omitted where possible.
  piece.first = std::max<int64_t>(n_t - 1 - count, 0);
  piece.first_s = clock.time[piece.first];
  piece.ftdc_deg = kCycle * std::ceil(clock.angle_deg[piece.first] / kCycle - 1e-9);
  piece.ftdc_s = time_at_angle(clock, piece.ftdc_deg);
  return piece;
}

Piece window(const RunClock& clock, const std::string& name, const Span& span, Taper taper,
             const std::string& origin) {
  Piece piece{.name = name, .step_s = clock.step_s, .taper = taper};
  const Eigen::VectorXd& axis = span.in_seconds ? clock.time : clock.angle_deg;
  if (axis.size() == 0)
    throw InputError(fmt::format(
        "{}: window '{}': found no crank rotation, expected a span in seconds", origin, name));
  const double first = axis[0], last = axis[axis.size() - 1];
  const double slack = 1e-6 * (last - first);
  if (!span.in_seconds) piece.ftdc_deg = kCycle * std::floor((last + slack - span.to) / kCycle);
  const double from = span.from + (span.in_seconds ? 0.0 : piece.ftdc_deg);
  const double to = span.to + (span.in_seconds ? 0.0 : piece.ftdc_deg);
  if (from < first - slack || to > last + slack || !(to > from))
    throw InputError(fmt::format(
        "{}: window '{}': found {:g} to {:g} {}, expected a span inside the run, {:g} to {:g}",
        origin, name, span.from, span.to, span.in_seconds ? "s" : "deg", first, last));
  piece.first = first_at(axis, from);
  piece.count = std::min<int64_t>(first_at(axis, to) + 1, axis.size()) - piece.first;
  if (piece.count < 2)
    throw InputError(fmt::format("{}: window '{}': found {} samples, expected at least 2", origin,
                                 name, piece.count));
  piece.first_s = piece.ftdc_s = clock.time[piece.first];
  if (span.in_seconds && clock.has_crank())
    piece.ftdc_deg = kCycle * std::round(clock.angle_deg[piece.first + piece.count / 2] / kCycle);
  if (clock.has_crank()) piece.ftdc_s = time_at_angle(clock, piece.ftdc_deg);
  return piece;
}

std::vector<int64_t> frame_samples(const RunClock& clock, const Piece& piece, const Span& span,
                                   double step) {
  const double per_sample = span.in_seconds ? clock.step_s : clock.speed_deg_s() * clock.step_s;
  const int64_t stride = std::max<int64_t>(std::llround(step / per_sample), 1);
  std::vector<int64_t> samples;
  for (int64_t i = 0; i < piece.count; i += stride) samples.push_back(piece.first + i);
  return samples;
}

}  // namespace clatter::recover
