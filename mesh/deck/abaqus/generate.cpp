// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/generate.hpp"

#include <fmt/format.h>

#include "mesh/deck/abaqus/generator.hpp"
#include "mesh/deck/abaqus/set_numbers.hpp"

namespace clatter::mesh::deck::abaqus {

int32_t Generator::number(int64_t id, Origin origin) const {
  if (id >= 1 && id <= kMostNumber) return static_cast<int32_t>(id);
  source_.fail(origin, fmt::format("{}: makes the number {}, expected 1 to {}", keyword_.name, id,
                                   kMostNumber));
}

void Generator::name_set(std::string_view parameter, IdSets& sets, std::vector<int32_t> more) {
  if (!keyword_.has(parameter)) return;
  SetChunk& chunk = new_chunk(sets, keyword_.required(parameter, source_), card_.origin());
  chunk.id_lines.emplace_back(0, card_.origin());
  chunk.ids = std::move(more);
  chunk.ids.insert(chunk.ids.end(), made_.begin(), made_.end());
}

std::vector<int32_t> Generator::set(const IdSets& sets, const std::string& name) const {
  return numbers_of_set(scope_, sets, name, source_, card_.origin());
}

int32_t Generator::parameter(std::string_view name) const {
  const std::string& text = keyword_.required(name, source_);
  return Fields(text, source_, card_.origin()).integer(0, name, -kMostNumber, kMostNumber);
}

void generate(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
              Ignore& ignore) {
  const std::string& key = card.keyword().key;
  if (key == "ELGEN" || key == "ELCOPY") return generate_elements(card, scope, source, ignore);
  if (key == "NMAP") return map_nodes(card, scope, source, ignore);
  generate_nodes(card, scope, system, source, ignore);
}

}  // namespace clatter::mesh::deck::abaqus
