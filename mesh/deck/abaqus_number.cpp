#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "mesh/deck/abaqus_writer.hpp"

namespace clatter::mesh::deck {
namespace {

constexpr size_t kWidth = 20;

// Digits without a point, and the power of ten of the first one.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

// `precision` digits behind the first one; -1 for as many as it takes to tell the double.
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
  const int n = static_cast<int>(decimal.digits.size());
  const int e = decimal.exponent;
  const std::string sign = decimal.negative ? "-" : "";
  const int shift = e - n + 1;  // of the digits as a whole number
  std::string best = sign + decimal.digits + (shift == 0 ? "." : "e" + std::to_string(shift));
  std::string fixed;
  if (e >= 0 && e < n) {
    fixed = decimal.digits.substr(0, static_cast<size_t>(e + 1)) + "." +
            decimal.digits.substr(static_cast<size_t>(e + 1));
  } else if (e < 0 && e > -static_cast<int>(kWidth)) {
    fixed = "." + std::string(static_cast<size_t>(-e - 1), '0') + decimal.digits;
  } else if (e < static_cast<int>(kWidth)) {
    fixed = decimal.digits + std::string(static_cast<size_t>(e > 0 ? shift : 0), '0') + ".";
  }
  const bool fits = !fixed.empty() && e > -static_cast<int>(kWidth);
  if (fits && sign.size() + fixed.size() <= std::max(best.size(), kWidth)) best = sign + fixed;
  return best;
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
