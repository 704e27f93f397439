// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Comma-separated fields.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/abaqus/source.hpp"

namespace clatter::mesh::deck::abaqus {

std::string_view trimmed(std::string_view text);
/// Upper case without blanks: how keywords, parameters and names are compared.
std::string folded(std::string_view text);

/// A finite number in C or Fortran notation (1.5, .5, +1, 1D3, 1.5-3); none for anything else.
std::optional<double> to_number(std::string_view text);
/// A 32-bit integer; none for anything else.
std::optional<int32_t> to_integer(std::string_view text);

/// Iterates over the fields of a line without allocation: for long tables.
class FieldWalk {
 public:
  explicit FieldWalk(std::string_view line) : rest_(line) {}
  /// The next field, trimmed; false after the last one. A trailing comma opens no new field.
  bool next(std::string_view* field);

 private:
  std::string_view rest_;
};

/// The fields of one data line. A missing or wrong field gives an InputError with line, field and
/// expectation. `line` must outlive the object.
class Fields {
 public:
  Fields(std::string_view line, const Source& source, Spot spot);

  size_t size() const { return fields_.size(); }
  /// Empty after the last field.
  std::string_view text(size_t i) const { return i < fields_.size() ? fields_[i] : ""; }
  bool empty(size_t i) const { return text(i).empty(); }
  /// At least one character; `what` describes the expected field.
  std::string word(size_t i, std::string_view what) const;
  double number(size_t i, std::string_view what) const;
  double number_or(size_t i, double fallback, std::string_view what) const;
  int32_t integer(size_t i, std::string_view what, int32_t low, int32_t high) const;
  /// InputError for more fields.
  void at_most(size_t count, std::string_view what) const;

  Spot spot() const { return spot_; }
  const Source& source() const { return *source_; }
  [[noreturn]] void fail(const std::string& message) const { source_->fail(spot_, message); }

 private:
  std::vector<std::string_view> fields_;
  const Source* source_;
  Spot spot_;
};

}  // namespace clatter::mesh::deck::abaqus
