// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/fields.hpp"

#include <fmt/format.h>

namespace clatter::mesh::deck::abaqus {
bool FieldWalk::next(std::string_view* field) {
  rest_ = trimmed(rest_);
  if (rest_.empty()) return false;
  const size_t quote = rest_.front() == '"' ? rest_.find('"', 1) : std::string_view::npos;
  const bool quoted = quote != std::string_view::npos;
  const size_t comma = rest_.find(',', quoted ? quote : 0);
  *field = quoted ? rest_.substr(1, quote - 1) : trimmed(rest_.substr(0, comma));
  rest_.remove_prefix(comma == std::string_view::npos ? rest_.size() : comma + 1);
  return true;
}

Fields::Fields(std::string_view line, const Source& source, Origin origin)
    : source_(&source), origin_(origin) {
  FieldWalk walk(line);
  std::string_view field;
  while (walk.next(&field)) fields_.push_back(field);
}

std::string Fields::word(size_t i, std::string_view what) const {
  if (blank(i)) fail(fmt::format("found nothing in field {}, expected {}", i + 1, what));
  return std::string(text(i));
}

double Fields::number(size_t i, std::string_view what) const {
  const auto value = to_number(text(i));
  if (!value) {
    fail(fmt::format("found {} in field {}, expected a number ({})", shown(text(i)), i + 1, what));
  }
  return *value;
}

double Fields::number_or(size_t i, std::string_view what, double fallback) const {
  return blank(i) ? fallback : number(i, what);
}

int32_t Fields::integer(size_t i, std::string_view what, int32_t low, int32_t high) const {
  const auto value = to_integer(text(i));
  if (!value || *value < low || *value > high) {
    fail(fmt::format("found {} in field {}, expected an integer from {} to {} ({})", shown(text(i)),
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
