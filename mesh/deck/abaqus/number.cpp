// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace clatter::mesh::deck {
namespace {

constexpr size_t kWidth = 20;

// Digits without a point, and the power of ten of the first one.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

// `precision` digits after the first one; -1 for the shortest that identifies the double.
Decimal decimal_of(double value, int precision) {
  std::array<char, 64> text;
  const auto end = precision < 0 ? std::to_chars(text.data(), text.data() + text.size(), value,
                                                 std::chars_format::scientific)
                                 : std::to_chars(text.data(), text.data() + text.size(), value,
                                                 std::chars_format::scientific, precision);
  std::string_view rest(text.data(), static_cast<size_t>(end.ptr - text.data()));
  Decimal out;
  out.negative = rest.front() == '-';
  if (out.negative) rest.remove_prefix(1);
  const size_t e = rest.find('e');
  for (const char c : rest.substr(0, e)) {
    if (c != '.') out.digits += c;
  }
  out.exponent = std::atoi(std::string(rest.substr(e + 1)).c_str());
  while (out.digits.size() > 1 && out.digits.back() == '0') out.digits.pop_back();
  return out;
}

// 123.45, .0012345 or 12345e-9, whichever is shortest.
std::string shortest(const Decimal& decimal) {
  const std::string& digits = decimal.digits;
  const int n = static_cast<int>(digits.size());
  const int e = decimal.exponent;
  const int shift = e - n + 1;  // of the digits as an integer
  const char* sign = decimal.negative ? "-" : "";
  const std::string as_integer =
      shift == 0 ? fmt::format("{}{}.", sign, digits) : fmt::format("{}{}e{}", sign, digits, shift);
  constexpr int kMost = static_cast<int>(kWidth);
  std::string fixed;
  if (e >= 0 && e < n) {
    const auto before = static_cast<size_t>(e + 1);
    fixed = fmt::format("{}{}.{}", sign, digits.substr(0, before), digits.substr(before));
  } else if (e < 0 && e > -kMost) {
    fixed = fmt::format("{}.{:0<{}}{}", sign, "", -e - 1, digits);
  } else if (e > 0 && e < kMost) {
    fixed = fmt::format("{}{}{:0<{}}.", sign, digits, "", shift);
  }
  return !fixed.empty() && fixed.size() <= std::max(as_integer.size(), kWidth) ? fixed : as_integer;
}

}  // namespace

std::string abaqus_number(double value) {
  if (value == 0.0) return "0.";
  std::string text = shortest(decimal_of(value, -1));
  for (int precision = 16; text.size() > kWidth; --precision) {
    text = shortest(decimal_of(value, precision));
  }
  return text;
}

}  // namespace clatter::mesh::deck
