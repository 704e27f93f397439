// SPDX-License-Identifier: GPL-3.0-or-later
// *NSET and *SURFACE of TYPE=NODE.
#include <fmt/format.h>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Nodes without a node index are left out; an empty set stays one.
void add_set(Model& model, const std::string& name, const std::vector<int32_t>& rows,
             Origin origin) {
  if (has_node_set(model.deck, name)) {
    model.source.fail(origin, fmt::format("found a second node set {}", shown(name)));
  }
  std::vector<NodeIndex> node_indices;
  for (const int32_t row : rows) {
    const int32_t node = model.node_map.mesh_node(row);
    const NodeIndex node_index = node != NodeMap::kNone ? node : model.node_map.find(row);
    if (node_index != NodeMap::kNone) node_indices.push_back(node_index);
  }
  if (rows.empty()) model.deck.mesh.node_sets[name] = {};
  add_node_set(model.deck, name, std::move(node_indices));
}

}  // namespace

void build_sets(Model& model) {
  const Numbering& numbering = model.numbering;
  // Sets may contain others: an error in one affects those around it, so only the first is
  // reported.
  model.refusals.attempt([&] {
    for (size_t use = 0; use < numbering.uses().size(); ++use) {
      for (const auto& [key, set] : numbering.uses()[use].scope->node_sets) {
        const Origin origin = set.chunks.front().origin;
        add_set(model, numbering.public_name(use, set.name),
                model.sets.nodes(use, set.name, origin), origin);
      }
    }
  });
  for_each_card(model, {"SURFACE"}, [&](size_t use, const Card& card) {
    if (!card.keyword().has("NAME")) throw FollowUp();  // refused by build_surfaces()
    const std::string& name = *card.keyword().find("NAME");
    const std::string public_name = numbering.public_name(use, name);
    const auto* rows = node_surface(model, use, name);
    const bool is_new = !model.deck.mesh.node_sets.contains(public_name);
    if (rows != nullptr && is_new) add_set(model, public_name, *rows, card.origin());
  });
}

}  // namespace clatter::mesh::deck::abaqus
