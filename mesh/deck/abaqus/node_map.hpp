// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Node indices of the deck: which nodes are in the mesh, which became points, in which axes they
// move.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/numbering.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// Maps rows of the Numbering to node indices of the Deck.
class NodeMap {
 public:
  /// No node index.
  static constexpr NodeIndex kNone = -1;

  NodeMap(const Numbering& numbering, Deck& deck) : numbering_(numbering), deck_(deck) {}
  /// The mesh node of each row, or kNone; before anything else.
  void set_mesh_nodes(std::vector<int32_t> mesh_node) { mesh_node_ = std::move(mesh_node); }

  /// The index that has the DoFs of a node; a node without cells becomes a point when requested.
  NodeIndex require(int32_t row);
  /// The same, kNone for a node without cells that nothing else requested: it has no stiffness.
  NodeIndex find(int32_t row) const;
  /// The mesh node, whatever has its rotations; kNone for points.
  int32_t mesh_node(int32_t row) const { return mesh_node_[row]; }
  /// Cell `cell` has the mesh node `copy` in place of that of `row`.
  void set_copy(int32_t cell, int32_t row, int32_t copy) { copies_[{cell, row}] = copy; }
  /// The mesh node of `row` in a cell.
  int32_t mesh_node_of(int32_t cell, int32_t row) const;
  bool is_point(NodeIndex node_index) const;
  /// Which mesh nodes have rotations: those of shells.
  void set_turning(std::vector<bool> turns) { turns_ = std::move(turns); }
  /// True for points and nodes of shells.
  bool turns(NodeIndex node_index) const {
    return is_point(node_index) || turns_[static_cast<size_t>(node_index)];
  }
  /// True for a row of a mesh node without rotations.
  bool is_of_solids(int32_t row) const { return mesh_node(row) != kNone && !turns(mesh_node(row)); }
  /// A point that moves with a mesh node and has rotations as well.
  NodeIndex point_upon(int32_t row);

  /// CalculiX: the translations of node `row` are the rotations of `reference`.
  void set_rotation_node(int32_t row, NodeIndex reference) { rotation_of_[row] = reference; }
  /// kNone where `row` is no such node.
  NodeIndex rotation_of(int32_t row) const;

  /// *TRANSFORM: the axes of those nodes are those of a system of Deck::systems.
  void set_displacement_system(const std::vector<int32_t>& rows, const std::string& name);
  /// Empty: the basic frame.
  const std::string& displacement_system(int32_t row) const;

 private:
  NodeIndex add_point(int32_t row);

  const Numbering& numbering_;
  Deck& deck_;
  std::vector<int32_t> mesh_node_;
  std::vector<bool> turns_;                                // by mesh node
  std::map<std::pair<int32_t, int32_t>, int32_t> copies_;  // by cell and row
  std::map<int32_t, NodeIndex> point_of_;                  // by row; also points on mesh nodes
  std::map<int32_t, NodeIndex> rotation_of_;               // by row
  std::vector<std::string> system_names_ = {""};
  std::vector<int32_t> system_of_;  // by row, empty where there is no *TRANSFORM
};

}  // namespace clatter::mesh::deck::abaqus
