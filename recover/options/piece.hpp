// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pieces of a run: the last cycle, windows around an event, and the frames to be written.
#include <cstdint>
#include <string>
#include <vector>

#include "recover/run/run_input.hpp"

namespace clatter::recover {

/// An interval in crank angle about firing top dead centre or in run time.
struct Span {
  double from = 0.0, to = 0.0;  // [deg] about the last firing TDC that fits, or run time [s]
  bool in_seconds = false;
};

/// Tapers for pieces that are not periodic (Harris 1978).
enum class Taper { kNone, kHann, kTukey, kFlatTop };
Taper taper_of(const std::string& name);
std::string name_of(Taper taper);
/// Values of a taper at `count` samples; Tukey has cosine flanks of a tenth of the length each.
Eigen::VectorXd taper_values(Taper taper, int64_t count);

/// A range of consecutive samples of the run.
struct Piece {
  std::string name{};
  int64_t first = 0, count = 0;
  double step_s = 0.0;
  double first_s = 0.0;   // run time of the first sample [s]
  double ftdc_s = 0.0;    // time origin of phases in run time: firing TDC [s]
  double ftdc_deg = 0.0;  // crank angle there, a multiple of 720
  bool periodic = false;  // the piece is exactly one cycle
  Taper taper = Taper::kNone;
  double start_s() const { return first_s - ftdc_s; }
  double duration_s() const { return static_cast<double>(count) * step_s; }
};

/// The last 720 degrees, first sample included, last excluded.
/// @throws InputError when the run is shorter than a cycle, or a cycle is not an integer number of
/// steps
Piece last_cycle(const RunClock& clock, const std::string& origin);

/// The samples in a span; in degrees about the last firing TDC for which the run covers the span.
/// @throws InputError when the run does not cover it or it holds fewer than 2 samples
Piece window(const RunClock& clock, const std::string& name, const Span& span, Taper taper,
             const std::string& origin);

/// Every n-th sample of a span, n = nearest to `step` (in the unit of the span), at least 1.
std::vector<int64_t> frame_samples(const RunClock& clock, const Piece& piece, const Span& span,
                                   double step);

}  // namespace clatter::recover
