// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/fields.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace clatter::mesh::deck::abaqus {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Extensions of from_chars: a plus sign, D for E, an exponent without a letter, numbers too
// small for a double (they are zero).
std::optional<double> fortran_number(std::string_view text) {
  std::array<char, 64> c_text;
  size_t n = 0;
  if (text.empty() || text.size() + 2 >= c_text.size()) return std::nullopt;
  bool exponent = false, digits = false;
  for (size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    const bool sign = c == '+' || c == '-';
    if (c == 'd' || c == 'D' || c == 'E') c = 'e';
    if (c == 'e') {
      if (exponent || !digits) return std::nullopt;
      exponent = true;
    } else if (sign && i > 0 && is_digit(text[i - 1] == '.' ? '0' : text[i - 1])) {
      if (exponent || !digits) return std::nullopt;
      exponent = true;
      c_text[n++] = 'e';
    } else if (!is_digit(c) && c != '.' && !sign) {
      return std::nullopt;
    }
    digits = digits || is_digit(c);
    c_text[n++] = c;
  }
  c_text[n] = '\0';
  char* end = nullptr;
  const double value = std::strtod(c_text.data(), &end);
  if (!digits || end != c_text.data() + n || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string folded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (!is_blank(c)) out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return out;
}

std::optional<double> to_number(std::string_view text) {
  double value = 0.0;
  const auto [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (trouble == std::errc() && end == text.data() + text.size() && std::isfinite(value)) {
    return value;
  }
  return fortran_number(text);
}

std::optional<int32_t> to_integer(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && is_digit(text[1])) text.remove_prefix(1);
  int32_t value = 0;
  const auto [end, trouble] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (trouble != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool FieldWalk::next(std::string_view* field) {
  rest_ = trimmed(rest_);
  if (rest_.empty()) return false;
  const size_t comma = rest_.find(',');
  *field = trimmed(rest_.substr(0, comma));
  rest_.remove_prefix(comma == std::string_view::npos ? rest_.size() : comma + 1);
  return true;
}

Fields::Fields(std::string_view line, const Source& source, Spot spot)
    : source_(&source), spot_(spot) {
  FieldWalk walk(line);
  std::string_view field;
  while (walk.next(&field)) fields_.push_back(field);
}

std::string Fields::word(size_t i, std::string_view what) const {
  if (empty(i)) fail(fmt::format("found nothing in field {}, expected {}", i + 1, what));
  return std::string(text(i));
}

double Fields::number(size_t i, std::string_view what) const {
  const auto value = to_number(text(i));
  if (!value) {
    fail(fmt::format("found '{}' in field {}, expected a number ({})", text(i), i + 1, what));
  }
  return *value;
}

double Fields::number_or(size_t i, double fallback, std::string_view what) const {
  return empty(i) ? fallback : number(i, what);
}

int32_t Fields::integer(size_t i, std::string_view what, int32_t low, int32_t high) const {
  const auto value = to_integer(text(i));
  if (!value || *value < low || *value > high) {
    fail(fmt::format("found '{}' in field {}, expected an integer from {} to {} ({})", text(i),
                     i + 1, low, high, what));
  }
  return *value;
}

void Fields::at_most(size_t count, std::string_view what) const {
  if (size() > count) {
    fail(fmt::format("found {} fields, expected at most {} ({})", size(), count, what));
  }
}

}  // namespace clatter::mesh::deck::abaqus
