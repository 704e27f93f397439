// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/recipe/names.hpp"

#include <fmt/format.h>

#include "mesh/deck/node_sets.hpp"
#include "mesh/deck/shell_joints.hpp"

namespace clatter::mesh::deck {

RecipeNames::RecipeNames(Deck& deck)
    : deck_(deck),
      n_nodes_(static_cast<int32_t>(deck.mesh.nodes.rows())),
      turns_(turning_flags(deck.mesh)) {
  for (const auto& [name, nodes] : deck.mesh.node_sets) sets_.try_emplace(nodes, name);
}

int32_t RecipeNames::label(int32_t node) const {
  const std::vector<int32_t>& ids = deck_.mesh.node_ids;
  return ids.empty() ? node + 1 : ids[node];
}

std::string RecipeNames::point(NodeIndex node_index) const {
  const Point& point = deck_.points[node_index - n_nodes_];
  return fmt::format("{}_{}", point.of_bolt ? "bolt" : "point", point.id);
}

std::string RecipeNames::node(NodeIndex node_index) {
  return node_set({node_index}, fmt::format("node_{}", label(node_index)));
}

std::string RecipeNames::node_set(std::vector<int32_t> nodes, const std::string& wish) {
  sort_unique(nodes);
  const auto known = sets_.find(nodes);
  if (known != sets_.end()) return known->second;
  const std::string base = wish.empty() ? "nodes" : wish;
  std::string name = base;
  for (int k = 2; deck_.mesh.node_sets.contains(name); ++k) name = fmt::format("{}_{}", base, k);
  deck_.mesh.node_sets[name] = nodes;
  sets_[std::move(nodes)] = name;
  return name;
}

NamedNodes RecipeNames::node_indices(const std::vector<NodeIndex>& node_indices,
                                     const std::string& wish) {
  NamedNodes named;
  std::vector<int32_t> nodes;
  for (const NodeIndex node_index : node_indices) {
    if (is_point(node_index))
      named.points.push_back(point(node_index));
    else
      nodes.push_back(node_index);
  }
  if (!nodes.empty()) named.node_set = node_set(std::move(nodes), wish);
  return named;
}

std::string RecipeNames::point_on_node(NodeIndex node_index) {
  const std::string name = fmt::format("on_node_{}", label(node_index));
  on_nodes_[name] = node(node_index);
  return name;
}

std::vector<std::pair<DofMask, std::vector<NodeIndex>>> RecipeNames::by_directions(
    const std::vector<NodeIndex>& node_indices, DofMask mask) const {
  std::vector<NodeIndex> turning, others;
  for (const NodeIndex index : node_indices) (turns(index) ? turning : others).push_back(index);
  std::vector<std::pair<DofMask, std::vector<NodeIndex>>> out;
  const auto shifts = static_cast<DofMask>(mask & kTranslations);
  if (!turning.empty() && mask != 0) out.emplace_back(mask, std::move(turning));
  if (!others.empty() && shifts != 0) out.emplace_back(shifts, std::move(others));
  return out;
}

std::vector<int> directions_of(DofMask mask) {
  std::vector<int> directions;
  for (int d = 0; d < 6; ++d)
    if ((mask >> d & 1) != 0) directions.push_back(d);
  return directions;
}

}  // namespace clatter::mesh::deck
