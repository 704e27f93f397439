// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/node_sets.hpp"

#include <algorithm>

namespace clatter::mesh::deck {

void sort_unique(std::vector<int32_t>& values) {
  if (!std::is_sorted(values.begin(), values.end())) std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool has_node_set(const Deck& deck, const std::string& name) {
  return deck.sets.contains(name) || deck.mesh.node_sets.contains(name);
}

void add_node_set(Deck& deck, const std::string& name, std::vector<NodeIndex> node_indices) {
  sort_unique(node_indices);
  const auto node_count = static_cast<NodeIndex>(deck.mesh.nodes.rows());
  const auto points = std::lower_bound(node_indices.begin(), node_indices.end(), node_count);
  if (points != node_indices.end()) deck.sets[name] = node_indices;
  if (points == node_indices.begin()) return;
  node_indices.erase(points, node_indices.end());
  deck.mesh.node_sets[name] = std::move(node_indices);
}

}  // namespace clatter::mesh::deck
