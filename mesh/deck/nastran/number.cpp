// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace clatter::mesh::deck {
namespace {

// "1.50e-03" to "1.5-3", "0.25" to ".25", "5" to "5."; the shortest form.
std::string compact(std::string_view plain) {
  const size_t e = std::min(plain.find('e'), plain.size());
  std::string mantissa(plain.substr(0, e));
  if (mantissa.find('.') == std::string::npos) mantissa += '.';
  while (mantissa.back() == '0') mantissa.pop_back();
  const size_t first = mantissa.find_first_not_of('-');
  if (mantissa[first] == '0' && mantissa.size() > first + 2) mantissa.erase(first, 1);
  if (e == plain.size()) return mantissa;
  const char sign = plain[e + 1] == '-' ? '-' : '+';
  const std::string_view digits = plain.substr(plain.find_first_of("123456789", e));
  return mantissa + sign + std::string(digits);
}

// Digits after the point, in fixed or scientific notation.
std::string rounded(double value, std::chars_format format, int digits) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, format, digits).ptr;
  return compact({text, static_cast<size_t>(end - text)});
}

}  // namespace

std::string nastran_number(double value, int width) {
  const std::string shortest = compact(fmt::format("{}", value));
  if (static_cast<int>(shortest.size()) <= width) return shortest;
  const int sign = std::signbit(value) ? 1 : 0;
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  const int exponent_width = std::abs(exponent) < 10 ? 2 : std::abs(exponent) < 100 ? 3 : 4;
  // Significant digits next to sign, point and exponent, or sign, point and leading zeros.
  const int scientific = width - sign - 1 - exponent_width;
  const int fixed = width - sign - 1 - std::max(0, -exponent - 1);
  const bool is_fixed = fixed >= scientific && exponent < width - sign - 2;
  int digits = is_fixed ? width - sign - 1 - std::max(0, exponent + 1) : scientific - 1;
  const auto format = is_fixed ? std::chars_format::fixed : std::chars_format::scientific;
  std::string text = rounded(value, format, digits);
  while (static_cast<int>(text.size()) > width) text = rounded(value, format, --digits);
  return text;
}

}  // namespace clatter::mesh::deck
