// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Keyword lines and data lines of a deck.
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/fields.hpp"
#include "mesh/deck/abaqus/source.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// The names that the user ignores (ReadOptions::ignore), compared without case, blanks and star,
/// and how often each was found.
class Ignore {
 public:
  explicit Ignore(const ReadOptions& options);
  /// True, and counted `times` under `name`, when the user ignores it.
  bool skips(const std::string& name, int64_t times = 1);
  const std::map<std::string, int64_t>& counted() const { return counted_; }

 private:
  std::set<std::string> names_;
  std::map<std::string, int64_t> counted_;
};

/// A keyword line with its continuation lines.
struct Keyword {
  std::string name;  // with star, upper case, single blanks: "*SOLID SECTION"
  std::string key;   // folded, without star: "SOLIDSECTION"
  std::vector<std::pair<std::string, std::string>> parameters;  // folded name, value as written
  Spot spot = 0;

  bool has(std::string_view parameter) const { return find(parameter) != nullptr; }
  /// Null if the parameter is missing.
  const std::string* find(std::string_view parameter) const;
  /// The value folded; `fallback` if the parameter is missing.
  std::string choice(std::string_view parameter, const std::string& fallback) const;
  /// InputError if the parameter is missing or has no value.
  const std::string& required(std::string_view parameter, const Source& source) const;
  /// InputError for the first parameter that is neither among `known` nor ignored by the user.
  void allow(std::initializer_list<std::string_view> known, const Source& source,
             Ignore* ignore) const;
};

/// The last line of decks that clatter writes.
inline constexpr std::string_view kEndMark = "** end of the mesh by clatter";

/// Splits a Source into keywords and data lines; follows *INCLUDE and the parameter INPUT of any
/// keyword; skips comments (**) and empty lines.
class Lines {
 public:
  enum class Kind { kEnd, kKeyword, kData };

  explicit Lines(Source* source) : source_(source) {}
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
  Spot spot() const { return source_->spot(); }
  const Source& source() const { return *source_; }

 private:
  bool next_line();
  void read_keyword();

  Source* source_;
  Keyword keyword_;
  std::string_view data_;
  bool held_ = false;  // data_ is the next line
  bool open_keyword_ = false, bare_keyword_ = false, marked_end_ = false;
};

/// A keyword with its data lines, kept until the entire deck is read.
class Card {
 public:
  explicit Card(Keyword keyword) : keyword_(std::move(keyword)) {}
  void add(std::string_view line, Spot spot);

  const Keyword& keyword() const { return keyword_; }
  Spot spot() const { return keyword_.spot; }
  size_t size() const { return lines_.size(); }
  Fields line(size_t i, const Source& source) const;

 private:
  struct Line {
    size_t end;
    Spot spot;
  };
  Keyword keyword_;
  std::string text_;  // the lines, concatenated
  std::vector<Line> lines_;
};

}  // namespace clatter::mesh::deck::abaqus
