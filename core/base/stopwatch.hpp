// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Time and memory of the steps of a stage.
#include <chrono>
#include <string>
#include <vector>

namespace clatter {

/// Wall seconds since construction or the last restart().
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Peak resident memory of this process so far [bytes]; 0 where there is no /proc.
long long peak_memory_bytes();

/// Records the named steps of a stage, prints each at its end.
class StepClock {
 public:
  struct Step {
    std::string name;
    double seconds;
    double peak_gib;
  };
  /// Ends the step that began at the previous call (or at construction) and records it.
  void lap(const std::string& name);
  /// Records steps timed by another process; the next step begins here.
  void adopt(const std::vector<Step>& steps);
  const std::vector<Step>& steps() const { return steps_; }
  double total_seconds() const { return total_.seconds(); }

 private:
  Stopwatch total_;
  Stopwatch lap_;
  std::vector<Step> steps_;
};

}  // namespace clatter
