// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pieces of a run: the last cycles, windows around an event, and the frames to be written.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "recover/run/run_input.hpp"

namespace clatter::recover {

/// An interval in crank angle about firing top dead centre or in run time.
struct Span {
  double from = -10.0, to = 60.0;  // [deg] about the last firing TDC that fits, or run time [s]
  bool in_seconds = false;
};

/// Tapers for pieces that are not periodic (Harris 1978).
enum class Taper { kNone, kHann, kTukey, kFlatTop };
std::string name_of(Taper taper);
/// Values of a taper at `count` samples; Tukey has cosine flanks of a tenth of the length each.
Eigen::VectorXd taper_values(Taper taper, int64_t count);

/// The variable over which samples of a piece are uniform.
enum class Domain { kTime, kAngle };
std::string name_of(Domain domain);

/// Segments into which a window is divided for averaging (Welch 1967).
struct SegmentRule {
  std::optional<double> length{};  // [deg], or [s]; 0: one segment, the entire window
  bool in_seconds = false;
  /// Share of a segment that the next one repeats: 0.5 without it, 0 of cycles as segments.
  std::optional<double> overlap{};
};

/// A window as requested.
struct WindowRule {
  std::string name = "ftdc";
  Span span{};
  Taper taper = Taper::kNone;
  Domain domain = Domain::kTime;
  SegmentRule segments{};
  std::optional<int> cycles{};  // so many at the end of the run, instead of the span
};

/// A range of the run in uniform steps: samples of the run, or values at uniform crank angles
/// between them. Over the angle, `step_s`, `first_s` and `ftdc_s` are times at the piece's mean
/// speed, so that a line at f [Hz] has the order f / mean_speed_hz.
struct Piece {
  std::string name{};
  int64_t first = 0, count = 0;  // over the angle `first` is the sample before the first value
  double step_s = 0.0;
  double first_s = 0.0;   // run time of the first sample [s]
  double ftdc_s = 0.0;    // time origin of phases in run time: firing TDC [s]
  double ftdc_deg = 0.0;  // crank angle there, a multiple of 720
  bool periodic = false;  // the piece, or each segment of it, is exactly one cycle
  Taper taper = Taper::kNone;
  Domain domain = Domain::kTime;
  double first_deg = 0.0, step_deg = 0.0;              // over the angle only
  double mean_speed_hz = 0.0, highest_speed_hz = 0.0;  // of the crank in the piece; 0 without one
  int64_t segment = 0,
          hop = 0;  // of a divided window: samples of a segment, and from one to the next
  double start_s() const { return first_s - ftdc_s; }
  double duration_s() const { return static_cast<double>(count) * step_s; }
  int64_t segments() const { return hop > 0 ? (count - segment) / hop + 1 : 1; }
  /// Whether powers are means over cycles, each one a segment.
  bool is_mean_of_cycles() const { return periodic && hop > 0 && hop == segment; }
  /// Whether the powers are means over an event, of which the energy power * duration_s() is the
  /// result: a taper or segments are for what goes on.
  bool has_energy() const { return !periodic && taper == Taper::kNone && segments() == 1; }
  /// Highest frequency at the mean speed for spectra up to `to_hz`: over the angle, an order is
  /// below `to_hz` at every speed in the piece, and within the accuracy of the resampling.
  double limit_hz(double to_hz, double run_step_s) const;
};

/// The last 720 degrees, first sample included, last excluded: samples of the run when the crank
/// turns steadily and a cycle is an integer number of steps, else values at uniform angles.
/// @throws InputError when the run is shorter than a cycle, or its speed varies too much
Piece last_cycle(const RunClock& clock, const std::string& origin);

/// The last `cycles` of 720 degrees under a name of their own, one cycle being the last one: as
/// last_cycle(), to the bit. Several are divided into cycles unless the rule says otherwise.
/// @throws InputError when the run has recorded fewer, or segments do not fit
Piece last_cycles(const RunClock& clock, const WindowRule& rule, const std::string& origin);

/// The window of a rule: last_cycles(), or the samples in a span, the one at its end excluded, so
/// that tones that fit the span have lines of their own; in degrees about the last firing TDC for
/// which the run covers the span.
/// @throws InputError when the run does not cover it, it holds fewer than 2 samples, or segments do
/// not fit
Piece window(const RunClock& clock, const WindowRule& rule, const std::string& origin);

/// Segment k of a window as a piece with one segment.
Piece segment_of(const Piece& window, int64_t k);

/// Positions of a piece over the angle, `count` values from value `offset` of it on: in samples of
/// the run from its first one.
Eigen::VectorXd positions(const RunClock& clock, const Piece& piece, int64_t offset, int64_t count);

/// Every n-th sample of a span, n = nearest to `step` (in the unit of the span), at least 1; for an
/// unsteady crank and a span in degrees the first sample in each step.
std::vector<int64_t> frame_samples(const RunClock& clock, const Piece& piece, const Span& span,
                                   double step);

}  // namespace clatter::recover
