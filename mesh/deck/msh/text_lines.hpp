// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Lines of a text file with fields in columns, and messages with file and line.
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

namespace clatter::mesh {

class TextLines {
 public:
  TextLines(std::istream& file, std::string name) : file_(file), name_(std::move(name)) {}

  /// Goes to the next line; false at the end.
  bool next();
  /// The same where a line has to follow; `what` is expected.
  void require(std::string_view what);
  const std::string& text() const { return line_; }
  /// The line without blanks at both ends.
  std::string_view trimmed_text() const;
  /// "part.unv:12"
  std::string where() const;
  [[noreturn]] void fail(const std::string& message) const;

  /// The integer of columns [begin, begin + width).
  int64_t integer(size_t begin, size_t width, std::string_view what) const;
  /// A number of those columns; empty ones are 0.
  double real(size_t begin, size_t width, std::string_view what) const;
  bool blank(size_t begin, size_t width) const;

 private:
  std::string_view column(size_t begin, size_t width) const;

  std::istream& file_;
  std::string name_, line_;
  int64_t number_ = 0;
};

}  // namespace clatter::mesh
