// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Public test files next to the source tree, not in it.
#include <filesystem>
#include <string>

#include "tests/paths.hpp"

namespace clatter::test {

/// `shared/data/<name>` next to the source tree, or further up if the tree is a nested working
/// copy; a nonexistent path if it is nowhere: the test skips.
inline std::filesystem::path shared_data(const std::string& name) {
  std::filesystem::path above = std::filesystem::path(CLATTER_SOURCE_DIR).parent_path();
  for (int level = 0; level < 3; ++level, above = above.parent_path()) {
    const std::filesystem::path folder = above / "shared" / "data" / name;
    if (std::filesystem::exists(folder)) return folder;
  }
  return std::filesystem::path("../shared/data") / name;
}

}  // namespace clatter::test
