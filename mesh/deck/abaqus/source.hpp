// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lines of an Abaqus deck and of its included files.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/deck/line_source.hpp"

namespace clatter::mesh::deck::abaqus {

/// Longest line.
inline constexpr size_t kLongestLine = size_t{1} << 20;

class Source : public LineSource {
 public:
  /// FileError when the deck cannot be read.
  explicit Source(const std::filesystem::path& deck);
  /// A deck in memory, called `name` in messages; include() is refused.
  Source(const std::string& name, std::string_view text);

  /// The next line without its line ending, or nothing at the end of the deck. Valid until the next
  /// call. BrokenDeck for a line of kLongestLine characters or more.
  std::optional<std::string_view> next();
  /// Continues with the file of that name: next to the file of the last line or, where there is
  /// none, in the deck's folder. InputError as LineSource::include().
  void include(const std::string& name, Origin origin);
};

}  // namespace clatter::mesh::deck::abaqus
