// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/card.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::mesh::deck::abaqus {

std::string folded_keyword(std::string_view name) {
  std::string key = folded(name);
  if (key.starts_with('*')) key.erase(0, 1);
  return key;
}

const std::string* Keyword::find(std::string_view parameter) const {
  for (const auto& [name_of, value] : parameters) {
    if (name_of == parameter) return &value;
  }
  return nullptr;
}

std::string Keyword::choice(std::string_view parameter, const std::string& fallback) const {
  const std::string* value = find(parameter);
  return value != nullptr ? folded(*value) : fallback;
}

const std::string& Keyword::required(std::string_view parameter, const Source& source) const {
  const std::string* value = find(parameter);
  if (value == nullptr || value->empty()) {
    source.fail(origin, fmt::format("{}: expected the parameter {}=", name, parameter));
  }
  return *value;
}

void Keyword::allow(std::initializer_list<std::string_view> known, const Source& source,
                    Ignore& ignore) const {
  for (const auto& [parameter, value] : parameters) {
    if (std::find(known.begin(), known.end(), parameter) != known.end()) continue;
    if (ignore.skips(parameter)) continue;
    source.fail(origin, fmt::format("{} with the parameter {} is not supported; ignore = [\"{}\"] "
                                    "reads it without the parameter",
                                    name, parameter, parameter));
  }
}

void Card::add(std::string_view line, Origin origin) {
  text_ += line;
  lines_.push_back({text_.size(), origin});
}

Fields Card::line(size_t i, const Source& source) const {
  const size_t begin = i == 0 ? 0 : lines_[i - 1].end;
  return Fields(std::string_view(text_).substr(begin, lines_[i].end - begin), source,
                lines_[i].origin);
}

}  // namespace clatter::mesh::deck::abaqus
