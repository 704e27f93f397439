// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/memory_limit.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/base/error.hpp"

namespace clatter {
namespace {

double chosen_gib = 0.0;

double page_bytes() { return static_cast<double>(sysconf(_SC_PAGE_SIZE)); }

}  // namespace

void set_memory_limit_gib(double gib) { chosen_gib = gib; }

double memory_limit_gib() {
  if (chosen_gib > 0.0) return chosen_gib;
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * page_bytes();
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0)
    bytes = std::min(bytes, static_cast<double>(space.rlim_cur));
  return bytes / kBytesPerGib;
}

double memory_in_use_gib() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * page_bytes() / kBytesPerGib;
}

double memory_left_gib(double enough) {
  if (memory_limit_gib() - memory_in_use_gib() < enough) malloc_trim(0);
  return std::max(0.0, memory_limit_gib() - memory_in_use_gib());
}

void require_memory(const std::string& what, double gib, const std::string& advice) {
  const double left = memory_left_gib(gib);
  if (gib <= left) return;
  throw MemoryShort(fmt::format("{} needs {}, {} of {} are left: {}", what, memory_text(gib),
                                memory_text(left), memory_text(memory_limit_gib()), advice));
}

std::string memory_text(double gib) {
  if (gib <= 0.0) return "0 MiB";
  const char* unit = "GiB";
  // Values that three digits would round up take the next unit.
  for (const char* smaller : {"MiB", "KiB"}) {
    if (gib >= 0.9995) break;
    gib *= 1024.0;
    unit = smaller;
  }
  const double digits = gib >= 100.0 ? 1.0 : gib >= 10.0 ? 10.0 : 100.0;
  return fmt::format("{} {}", std::round(gib * digits) / digits, unit);
}

double gib_of_doubles(double count) { return 8.0 * count / kBytesPerGib; }

}  // namespace clatter
