#include "core/stopwatch.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include "core/log.hpp"

namespace clatter {

long long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<long long>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

void StepClock::lap(const std::string& name) {
  const double gib = static_cast<double>(peak_memory_bytes()) / (1024.0 * 1024.0 * 1024.0);
  steps_.push_back({name, lap_.seconds(), gib});
  say(fmt::format("  {:<40} {:>8.2f} s   peak {:.2f} GiB", name, steps_.back().seconds, gib));
  lap_.restart();
}

}  // namespace clatter
