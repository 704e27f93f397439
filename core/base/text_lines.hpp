// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reads text files of numbers line by line; errors give file and line.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace clatter {

/// The lines of a file, held in memory.
class TextLines {
 public:
  /// InputError when there is no such file, FileError when it cannot be read.
  explicit TextLines(const std::filesystem::path& path);

  /// The next line, without its line end; false after the last one.
  bool next(std::string_view& line);
  /// 1-based number of the line that next() returned.
  int64_t number() const { return number_; }
  /// "file:line: found ..., expected ..." as an InputError.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;

  /// A finite number or an integer that takes up all of `word`; refused otherwise.
  double real(std::string_view word) const;
  int64_t integer(std::string_view word) const;

 private:
  std::filesystem::path path_;
  std::string text_;
  size_t at_ = 0;
  int64_t number_ = 0;
};

/// The words of a line, separated by blanks, tabs and commas.
std::vector<std::string_view> words_of(std::string_view line);

}  // namespace clatter
