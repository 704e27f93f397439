// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace clatter {

std::string json_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

std::string json_object(const JsonMembers& members) {
  std::string text = "{";
  for (const auto& [key, value] : members) {
    if (text.size() > 1) text += ", ";
    text += json_text(key) + ": " + value;
  }
  return text + "}";
}

void print_json(const JsonMembers& members) { std::puts(json_object(members).c_str()); }

}  // namespace clatter
