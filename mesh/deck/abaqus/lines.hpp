// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Keyword lines and data lines of a deck.
#include <string_view>

#include "mesh/deck/abaqus/card.hpp"
#include "mesh/deck/abaqus/parameters.hpp"
#include "mesh/deck/abaqus/source.hpp"

namespace clatter::mesh::deck::abaqus {

/// The last line of decks that clatter writes.
inline constexpr std::string_view kEndMark = "** end of the mesh by clatter";
/// A line of those with shells: as long as there is no section, sets of *ELEMENT are their regions.
inline constexpr std::string_view kShellMark = "** S3 and S4 of this mesh by clatter are shells";

/// Splits a Source into keywords and data lines; follows *INCLUDE and the parameter INPUT of any
/// keyword; skips comments (**) and empty lines.
class Lines {
 public:
  enum class Kind { kEnd, kKeyword, kData };

  explicit Lines(Source& source) : source_(source) {}
  Kind next();
  const Keyword& keyword() const { return keyword_; }
  /// The data line, trimmed, valid until next().
  std::string_view data() const { return data_; }
  /// True when the deck ended after the comma of a keyword line.
  bool open_keyword() const { return open_keyword_; }
  /// True when no data line followed the last keyword.
  bool bare_keyword() const { return bare_keyword_; }
  /// True when the last line of the deck was the final comment of our own writer.
  bool marked_end() const { return marked_end_; }
  /// True when a line was the comment of our own writer on shells.
  bool marked_shells() const { return marked_shells_; }
  Origin origin() const { return source_.origin(); }
  const Source& source() const { return source_; }
  /// Values of <name> in the lines that follow.
  Parameters& parameters() { return parameters_; }

 private:
  bool next_line();
  void read_keyword();

  Source& source_;
  Parameters parameters_;
  std::string replaced_;  // holds data_ if <name> was replaced
  Keyword keyword_;
  std::string_view data_;
  bool held_ = false;  // data_ is the next line
  bool open_keyword_ = false, bare_keyword_ = false, marked_end_ = false, marked_shells_ = false;
};

}  // namespace clatter::mesh::deck::abaqus
