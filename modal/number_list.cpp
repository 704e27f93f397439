// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/number_list.hpp"

#include <charconv>

namespace clatter::modal {

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  const char* at = text.data();
  const char* end = at + text.size();
  while (at < end) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || (next != end && *next != ',')) return {};
    out.push_back(value);
    at = next == end ? end : next + 1;
  }
  return out;
}

}  // namespace clatter::modal
