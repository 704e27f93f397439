// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Physical lines of a Nastran deck and of all included files.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clatter::mesh::deck::nastran {

/// A line, counted through all files of the deck; Source::where() gives file and line.
using Origin = uint32_t;

/// Files are read in blocks; only one block of each open file is in memory.
/// A deck may include others 64 deep and 10 000 times in all; lines other than comments may have 65
/// 536 characters. InputError beyond that, FileError when the deck itself cannot be read.
class Source {
 public:
  explicit Source(const std::filesystem::path& deck);
  /// Text in memory under a given name; it cannot include files.
  Source(const std::string& name, std::string_view text);
  ~Source();

  /// The next line without its line ending, or nothing at the end of the deck. The view is valid
  /// until the next call. Included files end silently.
  std::optional<std::string_view> next();
  /// The next call of next() returns the last line again.
  void unread() { again_ = true; }
  /// Continues with the file of that name: relative to the file of the last line, then to those
  /// that include it. InputError when there is none, or when it includes itself.
  void include(const std::string& name);

  /// Origin of the last line.
  Origin origin() const { return count_ - 1; }
  /// "file:line".
  std::string where(Origin origin) const;
  /// InputError "file:line: message".
  [[noreturn]] void fail(Origin origin, const std::string& message) const;
  /// The deck and all included files, in order, each once.
  const std::vector<std::string>& files() const { return files_; }

 private:
  struct Stream;
  struct Segment {
    Origin first;
    size_t file;
    Origin line;  // of `first` in its file
  };
  void open(const std::filesystem::path& path);
  size_t file_index(const std::string& name);
  void start_segment();

  std::vector<std::unique_ptr<Stream>> streams_;  // the innermost last
  std::vector<std::string> files_;
  std::vector<Segment> segments_;
  Origin count_ = 0;
  int includes_ = 0;
  bool again_ = false, in_memory_ = false;
  std::string_view last_;
};

/// `text` between quotes for messages: at most 40 characters, unprintable ones as '?'.
std::string shown(std::string_view text);

}  // namespace clatter::mesh::deck::nastran
