// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files that are read at once, and text files that are written completely or not at all.
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "core/base/part_names.hpp"

namespace clatter {

/// Writes to `path.part`; commit() syncs it to disk and renames it. Without commit() the part is
/// removed and an older file stays unchanged.
class WholeFile {
 public:
  /// FileError when the part cannot be opened.
  explicit WholeFile(const std::filesystem::path& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// FileError when a write failed.
  void commit();

 private:
  std::filesystem::path path_, part_;
  PartName unfinished_;
  std::ofstream stream_;
};

/// All bytes of a file. FileError when it cannot be read.
std::string read_whole_file(const std::filesystem::path& path);

/// Writes `text` as the complete file.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace clatter
