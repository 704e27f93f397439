#include "core/memory_limit.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "core/error.hpp"

namespace clatter {
namespace {

constexpr double kGib = 1024.0 * 1024.0 * 1024.0;
double chosen_gib = 0.0;

double page_bytes() { return static_cast<double>(sysconf(_SC_PAGE_SIZE)); }

}  // namespace

void set_memory_limit_gib(double gib) { chosen_gib = gib; }

double memory_limit_gib() {
  if (chosen_gib > 0.0) return chosen_gib;
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * page_bytes() / kGib;
}

double memory_in_use_gib() {
  std::ifstream file("/proc/self/statm");
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * page_bytes() / kGib;
}

double memory_left_gib(double enough) {
  if (memory_limit_gib() - memory_in_use_gib() < enough) malloc_trim(0);
  return std::max(0.0, memory_limit_gib() - memory_in_use_gib());
}

void require_memory(const std::string& what, double gib, const std::string& advice) {
  const double left = memory_left_gib(gib);
  if (gib <= left) return;
  throw NumericsError(fmt::format("{} needs {:.3g} GiB, {:.3g} of {:.3g} GiB are left: {}", what,
                                  gib, left, memory_limit_gib(), advice));
}

double gib_of_doubles(double count) { return 8.0 * count / kGib; }

}  // namespace clatter
