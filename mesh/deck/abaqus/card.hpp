// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A keyword with its data lines, and access to its parameters and fields.
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/fields.hpp"
#include "mesh/deck/ignore.hpp"

namespace clatter::mesh::deck::abaqus {

/// A keyword as names are compared: folded, without star.
std::string folded_keyword(std::string_view name);

/// A keyword line with its continuation lines.
struct Keyword {
  std::string name;  // with star, upper case, single blanks: "*SOLID SECTION"
  std::string key;   // folded, without star: "SOLIDSECTION"
  std::vector<std::pair<std::string, std::string>> parameters;  // folded name, value as written
  Origin origin = 0;

  bool has(std::string_view parameter) const { return find(parameter) != nullptr; }
  /// Null if the parameter is missing.
  const std::string* find(std::string_view parameter) const;
  /// The value folded; `fallback` if the parameter is missing.
  std::string choice(std::string_view parameter, const std::string& fallback) const;
  /// InputError if the parameter is missing or has no value.
  const std::string& required(std::string_view parameter, const Source& source) const;
  /// InputError for the first parameter that is neither among `known` nor ignored by the user.
  void allow(std::initializer_list<std::string_view> known, const Source& source,
             Ignore& ignore) const;
};

/// A keyword with its data lines, kept until the entire deck is read.
class Card {
 public:
  explicit Card(Keyword keyword) : keyword_(std::move(keyword)) {}
  void add(std::string_view line, Origin origin);

  const Keyword& keyword() const { return keyword_; }
  Origin origin() const { return keyword_.origin; }
  size_t size() const { return lines_.size(); }
  Fields line(size_t i, const Source& source) const;

 private:
  struct Line {
    size_t end;
    Origin origin;
  };
  Keyword keyword_;
  std::string text_;  // the lines, concatenated
  std::vector<Line> lines_;
};

}  // namespace clatter::mesh::deck::abaqus
