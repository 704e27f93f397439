// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "core/base/error.hpp"

namespace clatter {
namespace {

template <class Number>
bool parse(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

std::string quoted(std::string_view word) { return fmt::format("\"{}\"", word.substr(0, 40)); }

}  // namespace

TextLines::TextLines(const std::filesystem::path& path) : path_(path) {
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("{}: no such file", path.string()));
  std::ifstream file(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path) || !file)
    throw FileError(fmt::format("{}: cannot be read", path.string()));
  text_.resize(std::filesystem::file_size(path));
  file.read(text_.data(), static_cast<std::streamsize>(text_.size()));
  if (!file) throw FileError(fmt::format("{}: cannot be read", path.string()));
}

bool TextLines::next(std::string_view& line) {
  if (at_ >= text_.size()) return false;
  const size_t end = std::min(text_.find('\n', at_), text_.size());
  line = std::string_view(text_).substr(at_, end - at_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  at_ = end + 1;
  ++number_;
  return true;
}

void TextLines::refuse(const std::string& found, const std::string& expected) const {
  throw InputError(
      fmt::format("{}:{}: found {}, expected {}", path_.string(), number_, found, expected));
}

double TextLines::real(std::string_view word) const {
  double value = 0.0;
  if (!parse(word, value) || !std::isfinite(value)) refuse(quoted(word), "a finite number");
  return value;
}

int64_t TextLines::integer(std::string_view word) const {
  int64_t value = 0;
  if (!parse(word, value)) refuse(quoted(word), "an integer");
  return value;
}

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBetween = " \t,";
  std::vector<std::string_view> words;
  size_t begin = line.find_first_not_of(kBetween);
  while (begin != std::string_view::npos) {
    const size_t end = std::min(line.find_first_of(kBetween, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBetween, end);
  }
  return words;
}

}  // namespace clatter
