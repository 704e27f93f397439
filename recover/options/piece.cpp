// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/options/piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "recover/run/resample.hpp"

namespace clatter::recover {
namespace {

constexpr double kCycle = 720.0;

/// Index of the first sample not before `value`, with a millionth of a step of tolerance.
int64_t first_at(const Eigen::VectorXd& axis, double value) {
  const double step = (axis[axis.size() - 1] - axis[0]) / static_cast<double>(axis.size() - 1);
  return std::lower_bound(axis.begin(), axis.end(), value - 1e-6 * step) - axis.begin();
}

/// Mean and highest speed of the crank between two angles.
void measure_speed(const RunClock& clock, int64_t first, int64_t last, Piece& piece) {
  if (!clock.has_crank()) return;
  piece.mean_speed_hz = piece.highest_speed_hz = clock.speed_deg_s() / 360.0;
  if (clock.steady()) return;
  const int64_t n = last - first;
  const Eigen::VectorXd& angle = clock.angle_deg;
  piece.mean_speed_hz =
      (angle[last] - angle[first]) / (360.0 * static_cast<double>(n) * clock.step_s);
  piece.highest_speed_hz =
      (angle.segment(first + 1, n) - angle.segment(first, n)).maxCoeff() / (360.0 * clock.step_s);
}

/// The smallest product of 2, 3 and 5 that is even and at least `count`: fast to transform.
int64_t fast_length(int64_t count) {
  for (int64_t n = count + count % 2;; n += 2) {
    int64_t rest = n;
    for (int64_t p : {2, 3, 5})
      while (rest % p == 0) rest /= p;
    if (rest == 1) return n;
  }
}

/// A piece over the angle from `from_deg` to `to_deg`. The angle step is so small that half the
/// sampling frequency of the run lies below half that over the angle at the lowest speed in the
/// piece: nothing is aliased.
Piece by_angle(const RunClock& clock, const std::string& name, double from_deg, double to_deg,
               const std::string& origin) {
  constexpr double kMargin = 1.1, kLargestRatio = 20.0;
  Piece piece{.name = name, .domain = Domain::kAngle, .first_deg = from_deg};
  const Eigen::VectorXd& angle = clock.angle_deg;
  const int64_t last_sample = angle.size() - 1;
  const int64_t first =
      std::clamp<int64_t>(first_at(angle, from_deg) - 1, kHalfWidth, last_sample - kHalfWidth - 1);
  const int64_t last =
      std::clamp<int64_t>(first_at(angle, to_deg), first + 1, last_sample - kHalfWidth);
  const Eigen::VectorXd steps =
      angle.segment(first + 1, last - first) - angle.segment(first, last - first);
  const double lowest = steps.minCoeff(), highest = steps.maxCoeff();
  if (highest > kLargestRatio * lowest)
    throw InputError(fmt::format(
        "{}: '{}': found speeds of {:.4g} to {:.4g} rpm, expected at most a ratio of {:g} for an "
        "analysis over the angle: choose a shorter window",
        origin, name, lowest / 6.0 / clock.step_s, highest / 6.0 / clock.step_s, kLargestRatio));
  const int64_t per_cycle = fast_length(static_cast<int64_t>(std::ceil(kMargin * kCycle / lowest)));
  piece.step_deg = kCycle / static_cast<double>(per_cycle);
  piece.count = static_cast<int64_t>(std::floor((to_deg - from_deg) / piece.step_deg + 1e-6));
  const double begin_s = clock.time_at(from_deg), end_s = clock.time_at(to_deg);
  piece.mean_speed_hz = (to_deg - from_deg) / (360.0 * (end_s - begin_s));
  piece.highest_speed_hz = highest / (360.0 * clock.step_s);
  piece.step_s = piece.step_deg / (360.0 * piece.mean_speed_hz);
  piece.first = first;
  piece.ftdc_deg = kCycle * std::ceil(from_deg / kCycle - 1e-9);
  piece.first_s = begin_s;
  piece.ftdc_s = begin_s + (piece.ftdc_deg - from_deg) / (360.0 * piece.mean_speed_hz);
  return piece;
}

/// Highest and lowest angle at which the samples around an instant suffice for resampling.
Span resampled_range(const RunClock& clock) {
  const Eigen::VectorXd& angle = clock.angle_deg;
  if (angle.size() < 2 * kHalfWidth + 2) return {angle[0], angle[0]};
  return {angle[kHalfWidth], angle[angle.size() - 1 - kHalfWidth]};
}

Piece cycles_by_angle(const RunClock& clock, const std::string& name, int cycles,
                      const std::string& origin) {
  const Span range = resampled_range(clock);
  const double length = cycles * kCycle;
  if (range.to - range.from < length)
    throw InputError(fmt::format(
        "{}: output/crank_angle_deg: found {:.6g} degrees without the {} samples at each end, "
        "expected {} of {:g}: the speed varies, a cycle is no integer number of steps, or '{}' is "
        "over the angle, and values at uniform angles need samples around them: a longer run, with "
        "an engine time.record_cycles = {}",
        origin, range.to - range.from, kHalfWidth,
        cycles == 1 ? "a complete cycle" : fmt::format("{} cycles", cycles), length, name,
        cycles + 1));
  return by_angle(clock, name, range.to - length, range.to, origin);
}

/// Complete cycles in the samples of a run.
int complete_cycles(const RunClock& clock) {
  const double samples = static_cast<double>(clock.time.size());
  return static_cast<int>(samples * clock.speed_deg_s() * clock.step_s / kCycle + 1e-3);
}

/// The last cycles of the run, undivided.
Piece end_of_run(const RunClock& clock, const std::string& name, int cycles, Domain domain,
                 const std::string& origin) {
  const int64_t n_t = clock.time.size();
  const double steps = kCycle / (clock.speed_deg_s() * clock.step_s);
  // A remainder of a thousandth of a step is a phase error of 0.2 degrees at the Nyquist frequency.
  const bool is_integer = std::abs(steps - std::round(steps)) <= 1e-3;
  if (domain == Domain::kAngle || !clock.steady() || !is_integer)
    return cycles_by_angle(clock, name, cycles, origin);
  Piece piece{.name = name, .count = cycles * std::llround(steps), .step_s = clock.step_s};
  // The last sample repeats the one a cycle earlier and is omitted where possible.
  piece.first = std::max<int64_t>(n_t - 1 - piece.count, 0);
  piece.first_s = clock.time[piece.first];
  piece.ftdc_deg = kCycle * std::ceil(clock.angle_deg[piece.first] / kCycle - 1e-9);
  piece.ftdc_s = clock.time_at(piece.ftdc_deg);
  measure_speed(clock, piece.first, std::min(piece.first + piece.count, n_t - 1), piece);
  return piece;
}

/// Divides a window into segments, with the lengths of the rule.
void divide(const SegmentRule& rule, const std::string& origin, Piece& piece) {
  const double length = rule.length.value_or(0.0), overlap = rule.overlap.value_or(0.5);
  if (length == 0.0) return;
  const double step = rule.in_seconds                  ? piece.step_s
                      : piece.domain == Domain::kAngle ? piece.step_deg
                                                       : 360.0 * piece.mean_speed_hz * piece.step_s;
  const double samples = step > 0.0 ? length / step : 0.0;
  constexpr double kFewest = 8.0;
  if (!(samples > kFewest - 0.5) || samples > static_cast<double>(piece.count) + 0.5)
    throw InputError(fmt::format(
        "{}: window '{}': found segments of {:g} {}, {:.4g} samples, expected {:g} to {} samples",
        origin, piece.name, length, rule.in_seconds ? "s" : "deg", samples, kFewest, piece.count));
  piece.segment = std::llround(samples);
  piece.hop =
      std::max<int64_t>(std::llround(static_cast<double>(piece.segment) * (1.0 - overlap)), 1);
}

Piece window_by_angle(const RunClock& clock, const WindowRule& rule, const std::string& origin) {
  const Span& span = rule.span;
  if (!clock.has_crank())
    throw InputError(fmt::format(
        "{}: window '{}': domain = \"angle\" needs a crank that turns: give domain = \"time\"",
        origin, rule.name));
  const Span range = resampled_range(clock);
  constexpr double kSlack = 1e-6;  // [deg]
  double from = span.from, to = span.to, ftdc = 0.0;
  if (span.in_seconds) {
    from = clock.angle_at(span.from);
    to = clock.angle_at(span.to);
    ftdc = kCycle * std::round(0.5 * (from + to) / kCycle);
  } else {
    ftdc = kCycle * std::floor((range.to + kSlack - span.to) / kCycle);
    from += ftdc;
    to += ftdc;
  }
  if (from < range.from - kSlack || to > range.to + kSlack || !(to > from))
    throw InputError(fmt::format(
        "{}: window '{}': found {:.6g} to {:.6g} deg of the run, expected a span inside {:.6g} to "
        "{:.6g} deg: values over the angle need {} samples before and after it",
        origin, rule.name, from, to, range.from, range.to, kHalfWidth));
  Piece piece =
      by_angle(clock, rule.name, std::max(from, range.from), std::min(to, range.to), origin);
  piece.ftdc_deg = ftdc;
  piece.ftdc_s = piece.first_s + (ftdc - piece.first_deg) / (360.0 * piece.mean_speed_hz);
  piece.taper = rule.taper;
  if (piece.count < 2)
    throw InputError(fmt::format("{}: window '{}': found {} values, expected at least 2", origin,
                                 rule.name, piece.count));
  divide(rule.segments, origin, piece);
  return piece;
}

}  // namespace

double Piece::limit_hz(double to_hz, double run_step_s) const {
  if (domain == Domain::kTime) return to_hz;
  return std::min(to_hz, kPassband * 0.5 / run_step_s) * mean_speed_hz / highest_speed_hz;
}

Piece segment_of(const Piece& window, int64_t k) {
  Piece piece = window;
  const int64_t moved = k * window.hop;
  piece.first_s += static_cast<double>(moved) * window.step_s;
  if (window.domain == Domain::kAngle)
    piece.first_deg += static_cast<double>(moved) * window.step_deg;
  else
    piece.first += moved;
  if (window.hop > 0) piece.count = window.segment;
  piece.segment = piece.hop = 0;
  return piece;
}

Eigen::VectorXd positions(const RunClock& clock, const Piece& piece, int64_t offset,
                          int64_t count) {
  const bool steady = clock.steady();
  Eigen::VectorXd out(count);
  for (int64_t i = 0; i < count; ++i) {
    const double angle = piece.first_deg + static_cast<double>(offset + i) * piece.step_deg;
    const double at =
        steady ? clock.time_at(angle) : interpolate(clock.angle_deg, clock.time, angle);
    out[i] = (at - clock.time[0]) / clock.step_s;
  }
  return out;
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

std::string name_of(Domain domain) { return domain == Domain::kAngle ? "angle" : "time"; }

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
    throw InputError(origin + ": output/crank_angle_deg: a cycle needs a crank that turns");
  const int64_t n_t = clock.time.size();
  const int64_t count = std::llround(kCycle / (clock.speed_deg_s() * clock.step_s));
  if (count > n_t)
    throw InputError(fmt::format(
        "{}: output/time: found {} samples, expected a complete cycle of {}", origin, n_t, count));
  Piece piece = end_of_run(clock, "cycle", 1, Domain::kTime, origin);
  piece.periodic = true;
  return piece;
}

Piece last_cycles(const RunClock& clock, const WindowRule& rule, const std::string& origin) {
  if (!clock.has_crank())
    throw InputError(
        fmt::format("{}: window '{}': cycles need a crank that turns: give a span in seconds",
                    origin, rule.name));
  const int cycles = rule.cycles.value(), found = complete_cycles(clock);
  if (cycles > found)
    throw InputError(fmt::format(
        "{}: window '{}': cycles: found {}, expected at most {}, which the run has recorded: "
        "set record_cycles = {} in [time] of its run.toml, or a later end_s",
        origin, rule.name, cycles, found, cycles));
  Piece piece = end_of_run(clock, rule.name, cycles, rule.domain, origin);
  piece.taper = rule.taper;
  const int64_t cycle = piece.count / cycles;
  if (rule.segments.length) {
    divide(rule.segments, origin, piece);
  } else if (cycles > 1) {
    const double overlap = rule.segments.overlap.value_or(0.0);
    piece.segment = cycle;
    piece.hop = std::max<int64_t>(std::llround(static_cast<double>(cycle) * (1.0 - overlap)), 1);
  }
  piece.periodic = piece.taper == Taper::kNone && segment_of(piece, 0).count == cycle;
  return piece;
}

Piece window(const RunClock& clock, const WindowRule& rule, const std::string& origin) {
  if (rule.cycles) return last_cycles(clock, rule, origin);
  if (rule.domain == Domain::kAngle) return window_by_angle(clock, rule, origin);
  const Span& span = rule.span;
  Piece piece{.name = rule.name, .step_s = clock.step_s, .taper = rule.taper};
  const Eigen::VectorXd& axis = span.in_seconds ? clock.time : clock.angle_deg;
  if (axis.size() == 0)
    throw InputError(
        fmt::format("{}: window '{}': degrees need a crank that turns: give a span in seconds",
                    origin, rule.name));
  const double first = axis[0], last = axis[axis.size() - 1];
  const double slack = 1e-6 * (last - first);
  if (!span.in_seconds) piece.ftdc_deg = kCycle * std::floor((last + slack - span.to) / kCycle);
  const double from = span.from + (span.in_seconds ? 0.0 : piece.ftdc_deg);
  const double to = span.to + (span.in_seconds ? 0.0 : piece.ftdc_deg);
  if (from < first - slack || to > last + slack || !(to > from))
    throw InputError(fmt::format(
        "{}: window '{}': found {:g} to {:g} {}, expected a span inside the run, {:g} to {:g}",
        origin, rule.name, span.from, span.to, span.in_seconds ? "s" : "deg", first, last));
  piece.first = first_at(axis, from);
  piece.count = first_at(axis, to) - piece.first;
  if (piece.count < 2)
    throw InputError(fmt::format("{}: window '{}': found {} samples, expected at least 2", origin,
                                 rule.name, piece.count));
  piece.first_s = piece.ftdc_s = clock.time[piece.first];
  if (span.in_seconds && clock.has_crank())
    piece.ftdc_deg = kCycle * std::round(clock.angle_deg[piece.first + piece.count / 2] / kCycle);
  if (clock.has_crank()) piece.ftdc_s = clock.time_at(piece.ftdc_deg);
  measure_speed(clock, piece.first, piece.first + piece.count - 1, piece);
  divide(rule.segments, origin, piece);
  return piece;
}

std::vector<int64_t> frame_samples(const RunClock& clock, const Piece& piece, const Span& span,
                                   double step) {
  std::vector<int64_t> samples;
  if (!span.in_seconds && !clock.steady()) {
    const double first = clock.angle_deg[piece.first];
    for (int64_t i = 0; i < piece.count; ++i) {
      const double at = clock.angle_deg[piece.first + i] - first;
      // The first sample that is not before the next multiple of the step.
      if (at >= step * static_cast<double>(samples.size()) - 1e-6)
        samples.push_back(piece.first + i);
    }
    return samples;
  }
  const double per_sample = span.in_seconds ? clock.step_s : clock.speed_deg_s() * clock.step_s;
  const int64_t stride = std::max<int64_t>(std::llround(step / per_sample), 1);
  for (int64_t i = 0; i < piece.count; i += stride) samples.push_back(piece.first + i);
  return samples;
}

}  // namespace clatter::recover
