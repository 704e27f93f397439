// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lines of a deck and of all its included files, in reading order.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clatter::mesh::deck {

/// A line, counted from 0 through all files of a deck; LineSource::where() gives file and line.
using Origin = int32_t;

/// The common part of the sources of all formats. Files are read in blocks; only one block of each
/// open file is in memory. A deck may include others 64 deep and 10 000 times in all.
class LineSource {
 public:
  /// Origin of the last line.
  Origin origin() const { return count_ - 1; }
  /// "deck.inp:12"
  std::string where(Origin origin) const;
  /// Throws InputError "deck.inp:12: message".
  [[noreturn]] void fail(Origin origin, const std::string& message) const;
  /// The deck and all included files.
  const std::vector<std::string>& files() const { return files_; }

 protected:
  /// How files() names the files.
  enum class Listing {
    kEach,  // at each opening, as written
    kOnce,  // each once, by its path without "." and ".."
  };
  struct Stream;
  using Streams = std::vector<std::unique_ptr<Stream>>;

  /// Lines of more than `longest` characters are cut: they have one more. FileError when the deck
  /// cannot be read.
  LineSource(const std::filesystem::path& deck, size_t longest, Listing listing);
  /// Text in memory, called `name` in messages; it cannot include files.
  LineSource(const std::string& name, std::string_view text, size_t longest);
  LineSource(const LineSource&) = delete;
  LineSource& operator=(const LineSource&) = delete;
  ~LineSource();

  /// The next line without its line ending, or nothing at the end of the deck. Valid until the next
  /// call. BrokenDeck when there are more lines than an Origin can count.
  std::optional<std::string_view> next_line();
  /// True when the last line was the first one of its file.
  bool at_first_line() const;
  /// Folders of the open files, the innermost last: as written, and without links.
  std::vector<std::filesystem::path> written_folders() const;
  std::vector<std::filesystem::path> real_folders() const;
  /// Continues with the lines of the first candidate that is a file, then with what follows.
  /// InputError at `origin` that begins with `statement`: no such file, a file that includes
  /// itself, too many files, text in memory.
  void include(std::string_view statement, const std::string& name,
               const std::vector<std::filesystem::path>& candidates, Origin origin);

 private:
  struct Segment {
    Origin first;
    size_t file;
    Origin line;  // of `first` in its file
  };
  void open(const std::filesystem::path& path);
  size_t add_file(const std::string& name);
  void begin_segment();

  Streams streams_;  // the innermost last
  std::vector<std::string> files_;
  std::vector<Segment> segments_;
  Origin count_ = 0;
  int includes_ = 0;
  size_t longest_;
  Listing listing_ = Listing::kEach;
  bool in_memory_ = false;
};

}  // namespace clatter::mesh::deck
