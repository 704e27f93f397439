// SPDX-License-Identifier: GPL-3.0-or-later
// SET1.
#include <fmt/format.h>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void add_set(Model& model, const std::string& name, const NodeSet& set) {
  std::vector<NodeIndex> node_indices = model.node_indices(set.grids, set.origin, false);
  if (has_node_set(model.deck, name)) {
    model.source.fail(set.origin, fmt::format("found a second node set {}", shown(name)));
  }
  add_node_set(model.deck, name, std::move(node_indices));
}

}  // namespace

void build_sets(Model& model) {
  for (const auto& [id, set] : model.raw.node_sets) {
    const auto named = model.raw.set_names.find(id);
    const std::string name =
        named == model.raw.set_names.end() ? fmt::format("set_{}", id) : named->second;
    model.refusals.attempt([&, &one = set] { add_set(model, name, one); });
  }
}

}  // namespace clatter::mesh::deck::nastran
