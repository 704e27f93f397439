// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A card of bulk data with all its continuation lines, and access to its fields by type.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/deck.hpp"
#include "mesh/deck/field_text.hpp"
#include "mesh/deck/id_index.hpp"
#include "mesh/deck/nastran/fields.hpp"
#include "mesh/deck/nastran/source.hpp"

namespace clatter::mesh::deck::nastran {

/// An integer list of a card: single ones (first = last), FIRST THRU LAST BY STEP, and what EXCEPT
/// leaves of FIRST THRU LAST.
using IdList = std::vector<IdRange>;

/// Fields count from 0, field 2 of the first line; each further line brings 8 more (large: 4).
/// Text is in capitals, without blanks around it. Errors: InputError with file, line and card.
class Card {
 public:
  explicit Card(const Source& source) : source_(&source) {}

  void start(const LineFields& line, Origin origin);
  /// Adds a continuation line, or returns why it cannot follow.
  std::string append(const LineFields& line, Origin origin);
  /// Adds the lines of a continuation found elsewhere.
  std::string append(const Card& continuation);
  bool empty() const { return lines_.empty(); }
  void clear();

  std::string_view name() const { return name_; }
  /// Name of the continuation that the last line requires.
  const std::string& next() const { return next_; }
  Origin origin() const { return lines_.front().origin; }
  size_t size() const { return fields_.size(); }
  std::string_view text(size_t i) const;
  bool blank(size_t i) const { return text(i).empty(); }
  /// Text without blanks inside.
  std::string_view word(size_t i, const char* what) const;
  /// Blank from field i on.
  bool blank_from(size_t i) const;

  double number(size_t i, const char* what) const;
  double number_or(size_t i, const char* what, double fallback) const;
  /// 1 or more.
  int32_t id(size_t i, const char* what) const;
  int32_t id_or(size_t i, const char* what, int32_t fallback) const;
  int32_t integer(size_t i, const char* what) const;
  int32_t integer_or(size_t i, const char* what, int32_t fallback) const;
  /// Digits 1 to 6 as bits 0 to 5.
  DofMask components(size_t i, const char* what) const;
  DofMask components_or_none(size_t i, const char* what) const;
  /// Numbers from field i on, skipping blanks, up to a field that is not a number (its index in
  /// `end`).
  IdList ids(size_t i, const char* what, size_t* end = nullptr) const;
  bool is_integer(size_t i) const { return to_integer(text(i)).has_value(); }
  bool is_word(size_t i) const;

  /// "deck.bdf:12: GRID: " and the message; the line is that of field i.
  [[noreturn]] void fail(size_t i, const std::string& message) const;
  [[noreturn]] void fail_expected(size_t i, const char* what, const char* expected) const;
  /// Fails when field `count` or a later one is not blank.
  void at_most(size_t count) const;

 private:
  struct Line {
    size_t field;  // first field of the line
    Origin origin;
    bool large;
  };
  struct Field {
    uint32_t begin, length;  // in text_
  };
  void add(const LineFields& line, Origin origin);
  size_t leave_out(size_t i, const char* what, IdList& list) const;

  const Source* source_;
  std::string name_, next_, text_;
  std::vector<Field> fields_;
  std::vector<Line> lines_;
};

}  // namespace clatter::mesh::deck::nastran
