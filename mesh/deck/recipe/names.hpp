// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Names of nodes for recipe.hpp: points, and node sets of the mesh that are made on demand.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// A node set of the mesh (empty: none) and points by name.
struct NamedNodes {
  std::string node_set;
  std::vector<std::string> points;
};

/// Names nodes and points of a deck; new node sets are added to its mesh.
class RecipeNames {
 public:
  explicit RecipeNames(Deck& deck);

  bool is_point(NodeIndex node_index) const { return node_index >= n_nodes_; }
  /// True for points and nodes of shells, which have rotations.
  bool turns(NodeIndex node_index) const {
    return is_point(node_index) || turns_[static_cast<size_t>(node_index)];
  }
  /// "point_12", "bolt_12": its number in the deck.
  std::string point(NodeIndex node_index) const;
  /// "node_12": the node set of that node alone.
  std::string node(NodeIndex node_index);
  /// A node set of exactly these nodes: an existing one of the mesh, else a new one whose name
  /// begins with `wish`.
  std::string node_set(std::vector<int32_t> nodes, const std::string& wish);
  NamedNodes node_indices(const std::vector<NodeIndex>& node_indices, const std::string& wish);
  /// Those of the directions that the nodes have: nodes without rotations apart.
  std::vector<std::pair<DofMask, std::vector<NodeIndex>>> by_directions(
      const std::vector<NodeIndex>& node_indices, DofMask mask) const;
  /// The name of a point, or of one on a mesh node.
  std::string reference(NodeIndex node_index) {
    return is_point(node_index) ? point(node_index) : point_on_node(node_index);
  }
  /// The name of a point on a mesh node; records that it is needed.
  std::string point_on_node(NodeIndex node_index);
  const std::map<std::string, std::string>& points_on_nodes() const { return on_nodes_; }

 private:
  int32_t label(int32_t node) const;

  Deck& deck_;
  int32_t n_nodes_;
  std::vector<bool> turns_;  // by mesh node
  std::map<std::vector<int32_t>, std::string> sets_;
  std::map<std::string, std::string> on_nodes_;  // point -> node set
};

/// {0, 5} of the mask of x and rz.
std::vector<int> directions_of(DofMask mask);

}  // namespace clatter::mesh::deck
