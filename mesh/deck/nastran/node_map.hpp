// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Node indices of the deck: which grids are in the mesh, which became points, in which axes they
// move.
#include <Eigen/Core>
#include <vector>

#include "mesh/deck/deck.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"

namespace clatter::mesh::deck::nastran {

/// Maps rows of the GRID table to node indices of the Deck.
class NodeMap {
 public:
  /// No node index.
  static constexpr NodeIndex kNone = -1;

  NodeMap(const RawDeck& raw, Deck& deck) : raw_(raw), deck_(deck) {}
  /// The mesh node of each row, ascending, or kNone; before anything else.
  void set_mesh_nodes(std::vector<int32_t> mesh_node);

  /// The node index of a row; a grid without cells becomes a point when requested.
  NodeIndex require(size_t row);
  /// Makes the last row, which is new, a point.
  NodeIndex add_row();
  /// The same, kNone for a grid without cells that nothing else requested.
  NodeIndex find(size_t row) const { return index_of_row_[row]; }
  /// Row of a node index.
  size_t row_of(NodeIndex node_index) const {
    return static_cast<size_t>(row_of_index_[node_index]);
  }
  /// Nodes of the mesh.
  NodeIndex node_count() const { return node_count_; }
  bool is_point(NodeIndex node_index) const { return node_index >= node_count_; }
  /// Which mesh nodes have rotations: those of shells.
  void set_turning(std::vector<bool> turns) { turns_ = std::move(turns); }
  /// True for points and nodes of shells.
  bool turns(NodeIndex node_index) const {
    return is_point(node_index) || turns_[static_cast<size_t>(node_index)];
  }
  /// Position of a mesh node or a point.
  Eigen::Vector3d position(NodeIndex node_index) const;
  /// Number of its displacement system, 0: basic.
  int32_t displacement_system(NodeIndex node_index) const;
  /// How many rows have no node index.
  int64_t unused() const;

 private:
  const RawDeck& raw_;
  Deck& deck_;
  std::vector<NodeIndex> index_of_row_;
  std::vector<int32_t> row_of_index_;
  std::vector<bool> turns_;  // by mesh node
  NodeIndex node_count_ = 0;
};

}  // namespace clatter::mesh::deck::nastran
