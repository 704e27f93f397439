// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The time of a run, and how its loads start.
#include <filesystem>
#include <functional>
#include <string>

namespace clatter::dynamics {

/// [time] and [output].
struct TimeSpec {
  int cycles = 2;    // engine scenes
  int recorded = 1;  // the last ones of them, which are reported
  /// Further cycles up to `cycles`, until the velocities of each body differ by no more than this
  /// part from those of the cycle before; 0: exactly `cycles`.
  double settle = 0.0;
  std::filesystem::path start;    // the run file at whose end this run starts; empty: from rest
  double begin = 0.0, end = 0.0;  // [s]; engine scenes: 0 = FTDC of the last cycle
  double ramp = 0.0;              // loads grow from zero over this time at the start [s]
  double output_step = 2e-5;      // as requested; it is adjusted to the span [s]
  std::string output_step_where, film_every_where;  // "file:line: key", for messages
};

using TimeFunction = std::function<double(double)>;

/// Multiplies by the ramp of the start, 3 s^2 - 2 s^3, so that the motion can start from rest at
/// its ideal position.
TimeFunction ramped(const TimeSpec& time, TimeFunction value);

}  // namespace clatter::dynamics
