// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lines of a Nastran deck and of its included files.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/deck/line_source.hpp"

namespace clatter::mesh::deck::nastran {

/// Longest line that is not a comment.
inline constexpr size_t kLongestLine = size_t{1} << 16;

class Source : public LineSource {
 public:
  /// FileError when the deck cannot be read.
  explicit Source(const std::filesystem::path& deck);
  /// A deck in memory, called `name` in messages; include() is refused.
  Source(const std::string& name, std::string_view text);

  /// The next line without its line ending, or nothing at the end of the deck. Valid until the next
  /// call. InputError for a line of more than kLongestLine characters that is not a comment.
  std::optional<std::string_view> next();
  /// The next call of next() returns the last line again.
  void unread() { again_ = true; }
  /// Continues with the file of that name: next to the file of the last line, then to those that
  /// include it. InputError as LineSource::include().
  void include(const std::string& name, Origin origin);

 private:
  bool again_ = false;
  std::string_view last_;
};

}  // namespace clatter::mesh::deck::nastran
