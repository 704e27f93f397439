// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/node_map.hpp"

#include <algorithm>

namespace clatter::mesh::deck::nastran {

void NodeMap::set_mesh_nodes(std::vector<int32_t> mesh_node) {
  index_of_row_ = std::move(mesh_node);
  for (size_t row = 0; row < index_of_row_.size(); ++row) {
    if (index_of_row_[row] != kNone) row_of_index_.push_back(static_cast<int32_t>(row));
  }
  node_count_ = static_cast<NodeIndex>(row_of_index_.size());
}

NodeIndex NodeMap::require(size_t row) {
  NodeIndex& node_index = index_of_row_[row];
  if (node_index != kNone) return node_index;
  node_index = node_count_ + static_cast<NodeIndex>(deck_.points.size());
  const auto& at = raw_.grids.at[row];
  deck_.points.push_back({raw_.grids.ids[row], {at[0], at[1], at[2]}});
  row_of_index_.push_back(static_cast<int32_t>(row));
  return node_index;
}

NodeIndex NodeMap::add_row() {
  index_of_row_.push_back(kNone);
  return require(index_of_row_.size() - 1);
}

Eigen::Vector3d NodeMap::position(NodeIndex node_index) const {
  if (is_point(node_index)) return deck_.points[node_index - node_count_].at;
  return deck_.mesh.nodes.row(node_index).transpose();
}

int32_t NodeMap::displacement_system(NodeIndex node_index) const {
  return column_at(raw_.grids.cd, row_of(node_index));
}

int64_t NodeMap::unused() const {
  return std::count(index_of_row_.begin(), index_of_row_.end(), kNone);
}

}  // namespace clatter::mesh::deck::nastran
