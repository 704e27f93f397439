// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lines of an Abaqus deck and of its included files, in reading order.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::mesh::deck::abaqus {

/// Number of a line, counted from 0 through all files in the order of reading.
using Spot = int32_t;

/// Longest line, deepest nesting of included files.
inline constexpr size_t kLongestLine = size_t{1} << 20;
inline constexpr size_t kDeepestInclude = 64;

/// Streams lines: holds one line per file in memory, whatever the deck's size.
class Source {
 public:
  /// FileError when the deck cannot be opened.
  explicit Source(const std::filesystem::path& deck);
  /// A deck in memory, called `name` in messages; include() is refused.
  Source(std::string_view text, const std::string& name);

  /// The next line without its line ending, valid until the next call; false after the last one.
  /// InputError for a line of more than kLongestLine characters.
  bool next(std::string_view* line);
  /// Of the last line that next() returned.
  Spot spot() const { return static_cast<Spot>(lines_ - 1); }
  /// "deck.inp:12"
  std::string where(Spot spot) const;
  /// Continues with the lines of another file, relative to the file of `spot` or, where there is
  /// none, to the deck's folder; then with what follows. InputError for a missing file, for one
  /// that is open already and for kDeepestInclude nested files.
  void include(const std::string& name, Spot spot);
  /// The deck and all included files, in the order of opening.
  const std::vector<std::string>& files() const { return files_; }

  /// Throws InputError "deck.inp:12: message".
  [[noreturn]] void fail(Spot spot, const std::string& message) const {
    throw InputError(where(spot) + ": " + message);
  }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct OpenFile {
    std::unique_ptr<std::FILE, Closer> stream;  // none: a deck in memory
    std::filesystem::path path;
    int32_t name = 0;        // index into files_
    int32_t line = 0;        // lines returned so far
    std::vector<char> kept;  // text that was read but not returned yet
    std::string_view text;
    bool at_end = false;
  };
  struct Segment {
    int64_t first;  // number of the line before it, counted through all files
    int32_t file, line;
  };

  void open(const std::filesystem::path& path);
  bool refill(OpenFile& file);
  void begin_segment();

  bool in_memory_ = false;
  std::vector<std::string> files_;
  std::vector<OpenFile> open_;
  std::vector<Segment> segments_;
  int64_t lines_ = 0;
};

}  // namespace clatter::mesh::deck::abaqus
