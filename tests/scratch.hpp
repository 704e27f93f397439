// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files of tests: CTest runs the tests of a program at the same time, each as a process of its own.
#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>

namespace clatter::test {

/// A path among the temporary files that no other process uses, ending with `name`.
inline std::filesystem::path scratch_path(std::string_view name) {
  return std::filesystem::temp_directory_path() / fmt::format("clatter_{}_{}", ::getpid(), name);
}

}  // namespace clatter::test
