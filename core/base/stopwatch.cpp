// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/stopwatch.hpp"

#include <fmt/format.h>

#include <fstream>

#include "core/base/log.hpp"

namespace clatter {

long long peak_memory_bytes() {
  // Not getrusage: its peak includes the memory of the parent at the fork.
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long long kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib * 1024;
  }
  return 0;
}

void StepClock::lap(const std::string& name) {
  const double gib = static_cast<double>(peak_memory_bytes()) / (1024.0 * 1024.0 * 1024.0);
  steps_.push_back({name, lap_.seconds(), gib});
  say(fmt::format("  {:<40} {:>8.2f} s   peak {:.2f} GiB", name, steps_.back().seconds, gib));
  lap_.restart();
}

void StepClock::adopt(const std::vector<Step>& steps) {
  steps_.insert(steps_.end(), steps.begin(), steps.end());
  lap_.restart();
}

}  // namespace clatter
