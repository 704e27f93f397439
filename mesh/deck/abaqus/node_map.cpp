// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/node_map.hpp"

namespace clatter::mesh::deck::abaqus {

NodeIndex NodeMap::find(int32_t row) const {
  const auto point = point_of_.find(row);
  return point != point_of_.end() ? point->second : mesh_node(row);
}

NodeIndex NodeMap::require(int32_t row) {
  const NodeIndex node_index = find(row);
  return node_index != kNone ? node_index : add_point(row);
}

int32_t NodeMap::mesh_node_of(int32_t cell, int32_t row) const {
  if (copies_.empty()) return mesh_node(row);
  const auto copy = copies_.find({cell, row});
  return copy != copies_.end() ? copy->second : mesh_node(row);
}

bool NodeMap::is_point(NodeIndex node_index) const {
  return node_index >= static_cast<NodeIndex>(deck_.mesh.nodes.rows());
}

NodeIndex NodeMap::add_point(int32_t row) {
  const auto node_index =
      static_cast<NodeIndex>(deck_.mesh.nodes.rows() + static_cast<int64_t>(deck_.points.size()));
  deck_.points.push_back({numbering_.node_ids()[row], numbering_.at(row)});
  point_of_[row] = node_index;
  return node_index;
}

NodeIndex NodeMap::point_upon(int32_t row) {
  const auto point = point_of_.find(row);
  return point != point_of_.end() ? point->second : add_point(row);
}

NodeIndex NodeMap::rotation_of(int32_t row) const {
  const auto at = rotation_of_.find(row);
  return at != rotation_of_.end() ? at->second : kNone;
}

void NodeMap::set_displacement_system(const std::vector<int32_t>& rows, const std::string& name) {
  if (system_of_.empty()) system_of_.assign(numbering_.nodes(), 0);
  for (const int32_t row : rows) {
    system_of_[row] = static_cast<int32_t>(system_names_.size());
  }
  system_names_.push_back(name);
}

const std::string& NodeMap::displacement_system(int32_t row) const {
  return system_of_.empty() ? system_names_.front() : system_names_[system_of_[row]];
}

}  // namespace clatter::mesh::deck::abaqus
