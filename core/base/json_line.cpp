// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/json_line.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace clatter {

std::string json_text(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

// By fmt: counts stay integers in the text (nlohmann writes 12.0).
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
