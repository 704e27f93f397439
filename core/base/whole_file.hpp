#pragma once
// Text files that appear complete or not at all.
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/base/part_names.hpp"

namespace clatter {

/// Writes to `path.part`; commit() syncs it to disk and gives it its name. Without commit() nothing
/// stands under the name, an older file there stays, and the part is removed.
class WholeFile {
 public:
  /// FileError when the part cannot be opened.
  explicit WholeFile(const std::filesystem::path& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// FileError when anything could not be written.
  void commit();

 private:
  std::filesystem::path path_, part_;
  PartName unfinished_;
  std::ofstream stream_;
};

/// The whole text at once.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace clatter
