// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/text_lines.hpp"

#include <fmt/format.h>

#include <charconv>

#include "core/base/error.hpp"
#include "mesh/deck/field_text.hpp"

namespace clatter::mesh {

bool TextLines::next() {
  if (!std::getline(file_, line_)) return false;
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  ++number_;
  return true;
}

void TextLines::require(std::string_view what) {
  if (!next()) fail(fmt::format("found the end of the file, expected {}", what));
}

std::string_view TextLines::trimmed_text() const { return deck::trimmed(line_); }

std::string TextLines::where() const { return fmt::format("{}:{}", name_, number_); }

void TextLines::fail(const std::string& message) const {
  throw InputError(fmt::format("{}: {}", where(), message));
}

std::string_view TextLines::column(size_t begin, size_t width) const {
  if (begin >= line_.size()) return {};
  return deck::trimmed(std::string_view(line_).substr(begin, width));
}

bool TextLines::blank(size_t begin, size_t width) const { return column(begin, width).empty(); }

int64_t TextLines::integer(size_t begin, size_t width, std::string_view what) const {
  const std::string_view text = column(begin, width);
  int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    fail(fmt::format("found {} in columns {} to {}, expected {}", deck::shown(text), begin + 1,
                     begin + width, what));
  return value;
}

double TextLines::real(size_t begin, size_t width, std::string_view what) const {
  const std::string_view text = column(begin, width);
  if (text.empty()) return 0.0;
  const auto value = deck::to_number(text);
  if (!value)
    fail(fmt::format("found {} in columns {} to {}, expected {}", deck::shown(text), begin + 1,
                     begin + width, what));
  return *value;
}

}  // namespace clatter::mesh
