// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/field_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace clatter::mesh::deck {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

// Extensions of from_chars: a plus sign, D for E, an exponent without a letter, numbers too
// small for a double (they are zero).
std::optional<double> fortran_number(std::string_view text) {
  std::array<char, 80> c_text;
  size_t n = 0;
  if (text.empty() || text.size() + 2 >= c_text.size()) return std::nullopt;
  bool exponent = false, digits = false;
  for (size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    const bool sign = c == '+' || c == '-';
    if (c == '+' && i == 0 && !text.starts_with("+-")) continue;
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
  // Not strtod, which reads as the language of the application does (hard case P13).
  double value = 0.0;
  const char* const all = c_text.data() + n;
  const auto [end, trouble] = std::from_chars(c_text.data(), all, value);
  if (!digits || end != all || !std::isfinite(value)) return std::nullopt;
  if (trouble == std::errc()) return value;
  const bool tiny = std::string_view(c_text.data(), n).find("e-") != std::string_view::npos;
  return trouble == std::errc::result_out_of_range && tiny ? std::optional(0.0) : std::nullopt;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string capitals(std::string_view text) {
  std::string out;
  append_capitals(text, out);
  return out;
}

void append_capitals(std::string_view text, std::string& out) {
  for (const char c : text) out += capital(c);
}

std::string folded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (!is_blank(c)) out += capital(c);
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

std::string shown(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > 40 ? "...'" : "'");
}

}  // namespace clatter::mesh::deck
