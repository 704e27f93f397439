// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/large_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/child_process.hpp"
#include "core/base/memory_limit.hpp"

namespace clatter {
namespace {

/// The flags of the mapping in which `address` lies, of /proc/self/smaps: "rd wr mr mw me ac hg".
std::string flags_at(const void* address) {
  const auto wanted = reinterpret_cast<uintptr_t>(address);
  std::ifstream file("/proc/self/smaps");
  bool within = false;
  for (std::string line; std::getline(file, line);) {
    uintptr_t first = 0, last = 0;
    char dash = 0;
    if (std::istringstream range(line); range >> std::hex >> first >> dash >> last && dash == '-')
      within = first <= wanted && wanted < last;
    if (within && line.starts_with("VmFlags:")) return line.substr(9);
  }
  return "";
}

#ifndef __SANITIZE_ADDRESS__
TEST(LargePages, TheHeapHasThemAndAddressesWithoutAccessAreNoMemory) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage"))
    GTEST_SKIP() << "the kernel has no transparent large pages";
  const ChildEnd end = run_in_child({}, [] {
    const double before = memory_in_use_gib();
    keep_freed_memory();
    const double grown = memory_in_use_gib() - before;
    const std::vector<double> array(1 << 22);
    return flags_at(&array[array.size() / 2]) + (grown < 0.01 ? " small" : " large");
  });
  EXPECT_NE(end.result.find(" hg "), std::string::npos) << end.result;
  EXPECT_TRUE(end.result.ends_with(" small")) << end.result;
}
#endif

}  // namespace
}  // namespace clatter
