// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Comma-separated fields.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/abaqus/source.hpp"
#include "mesh/deck/field_text.hpp"

namespace clatter::mesh::deck::abaqus {

/// Iterates over the fields of a line without allocation: for long tables.
class FieldWalk {
 public:
  explicit FieldWalk(std::string_view line) : rest_(line) {}
  /// The next field, trimmed, without its quotes; false after the last one. A trailing comma opens
  /// no new field.
  bool next(std::string_view* field);

 private:
  std::string_view rest_;
};

/// The fields of one data line. A missing or wrong field gives an InputError with line, field and
/// expectation. `line` must outlive the object.
class Fields {
 public:
  Fields(std::string_view line, const Source& source, Origin origin);

  size_t size() const { return fields_.size(); }
  /// Empty after the last field.
  std::string_view text(size_t i) const { return i < fields_.size() ? fields_[i] : ""; }
  bool blank(size_t i) const { return text(i).empty(); }
  /// At least one character; `what` describes the expected field.
  std::string word(size_t i, std::string_view what) const;
  double number(size_t i, std::string_view what) const;
  double number_or(size_t i, std::string_view what, double fallback) const;
  int32_t integer(size_t i, std::string_view what, int32_t low, int32_t high) const;
  /// InputError for more fields.
  void at_most(size_t count, std::string_view what) const;

  Origin origin() const { return origin_; }
  const Source& source() const { return *source_; }
  [[noreturn]] void fail(const std::string& message) const { source_->fail(origin_, message); }

 private:
  std::vector<std::string_view> fields_;
  const Source* source_;
  Origin origin_;
};

}  // namespace clatter::mesh::deck::abaqus
