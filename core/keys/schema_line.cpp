// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/keys/schema_line.hpp"

#include <filesystem>

namespace clatter::keys {

// Programs are in bin, or for several generations of processors in libexec/clatter/<processor>.
std::string schema_line(const std::string& kind) {
  std::error_code none;
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* up : {"..", "../../.."}) {
    const std::filesystem::path schema =
        (folder / up / "share/clatter/schemas" / (kind + ".schema.json")).lexically_normal();
    if (std::filesystem::exists(schema, none)) return "#:schema file://" + schema.string() + "\n";
  }
  return "";
}

}  // namespace clatter::keys
