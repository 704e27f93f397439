// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a deck holds and what its reader did with it: for `clatter-mesh --check` (check.hpp), and
// for the line of a run that names what is passed over.
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>

#include "mesh/deck/line_source.hpp"

namespace clatter::mesh::deck {

/// What the reader does: reads it; passes it over because it does not change the model; skips it
/// because the user ignores it; refuses it.
enum class Fate { kRead, kPassed, kIgnored, kRefused };

/// A row of a reader's table.
struct Listed {
  std::string name;
  Fate fate = Fate::kRead;
  std::string remark;  // what it becomes or is, or why it is refused
};

/// All cards, keywords, elements or commands of one name.
struct Content {
  std::string kind;  // "card", "keyword", "element", "case control", ...
  std::string name;
  Fate fate = Fate::kRead;
  std::string_view meaning;  // of the reader's table: what it becomes, or why it is passed over
  int64_t count = 0;
  std::string first;  // "deck.bdf:12"
};

/// Rows in the order in which the names were first found.
class Contents {
 public:
  /// Counts `times` of a name; returns its row, which stays where it is. Repetitions of the last
  /// name cost a comparison.
  Content& count(std::string_view kind, std::string_view name, const LineSource& source,
                 Origin origin, int64_t times = 1);
  /// Counts what is passed over, and why.
  void pass(std::string_view kind, std::string_view name, const LineSource& source, Origin origin,
            std::string_view why, int64_t times = 1);
  const std::deque<Content>& rows() const { return rows_; }
  /// "passed over, since neither stiffness nor mass depends on it: of output: *PRINT (2); ..."; by
  /// the reason, else the kind. Empty when nothing is.
  std::string passed_line() const;

 private:
  std::deque<Content> rows_;
  std::map<std::string, Content*, std::less<>> by_name_;  // "kind name"
  Content* last_ = nullptr;
};

}  // namespace clatter::mesh::deck
