// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/read_sets.hpp"

#include <fmt/format.h>

#include <limits>

namespace clatter::mesh::deck::abaqus {
namespace {

// An entry of a set: a number, or the name of another set.
void add_member(std::string_view field, Origin origin, SetChunk& chunk) {
  if (field.empty()) return;
  if (const auto id = to_integer(field)) {
    chunk.ids.push_back(*id);
  } else {
    chunk.names.emplace_back(std::string(field), origin);
  }
}

IdRange range_of(const Lines& lines) {
  const Fields fields(lines.data(), lines.source(), lines.origin());
  constexpr int32_t kMost = std::numeric_limits<int32_t>::max();
  IdRange range;
  range.first = fields.integer(0, "first number", 1, kMost);
  range.last = fields.blank(1) ? range.first : fields.integer(1, "last number", 1, kMost);
  range.step = fields.blank(2) ? 1 : fields.integer(2, "step", 1, kMost);
  fields.at_most(3, "first, last, step");
  if (range.last < range.first) {
    fields.fail(fmt::format("found {} to {}, expected ascending numbers", range.first, range.last));
  }
  return range;
}

}  // namespace

SetChunk& new_chunk(IdSets& sets, const std::string& name, Origin origin) {
  IdSet& set = sets[folded(name)];
  if (set.chunks.empty()) set.name = name;
  set.chunks.emplace_back();
  set.chunks.back().origin = origin;
  return set.chunks.back();
}

Lines::Kind read_set(Lines& lines, Scope& scope, Ignore& ignore) {
  const Keyword keyword = lines.keyword();
  const bool of_nodes = keyword.key == "NSET";
  keyword.allow(
      {of_nodes ? "NSET" : "ELSET", "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED", "ELSET"},
      lines.source(), ignore);
  IdSets& sets = of_nodes ? scope.node_sets : scope.element_sets;
  const std::string& name = keyword.required(of_nodes ? "NSET" : "ELSET", lines.source());
  SetChunk& chunk = new_chunk(sets, name, keyword.origin);
  if (keyword.has("UNSORTED")) sets[folded(name)].unsorted = true;
  if (const std::string* instance = keyword.find("INSTANCE")) chunk.instance = *instance;
  if (of_nodes && keyword.has("ELSET")) {
    chunk.elements_of.push_back(keyword.required("ELSET", lines.source()));
  }
  const bool generate = keyword.has("GENERATE");
  Lines::Kind kind = lines.next();
  for (; kind == Lines::Kind::kData; kind = lines.next()) {
    if (generate) {
      chunk.ranges.push_back(range_of(lines));
      continue;
    }
    chunk.id_lines.emplace_back(chunk.ids.size(), lines.origin());
    FieldWalk walk(lines.data());
    std::string_view field;
    while (walk.next(&field)) add_member(field, lines.origin(), chunk);
  }
  return kind;
}

}  // namespace clatter::mesh::deck::abaqus
