// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shared state of the second pass: the model, the deck being built, and the map of nodes.
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/abaqus/sets.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::abaqus {

/// Maps rows of the model to node indices of the deck.
class NodeMap {
 public:
  /// No node index.
  static constexpr NodeIndex kNone = -1;

  /// `mesh_node`: the mesh node of each row, or kNone.
  NodeMap(const Model* model, Deck* deck, std::vector<int32_t> mesh_node);

  /// The index that has the DoFs of a node; a node without cells becomes a point when requested.
  NodeIndex of(int32_t row);
  /// The same, kNone for a node without cells that nothing else requested: it has no stiffness.
  NodeIndex find(int32_t row) const;
  /// The mesh node, whatever has its rotations; kNone for points.
  int32_t mesh_node(int32_t row) const { return mesh_node_[static_cast<size_t>(row)]; }
  bool is_point(NodeIndex node_index) const;
  /// A point that moves with a mesh node and has rotations as well.
  NodeIndex point_upon(int32_t row);

  /// CalculiX: the translations of node `row` are the rotations of `reference`.
  void set_rotation_node(int32_t row, NodeIndex reference) { rotation_of_[row] = reference; }
  /// kNone where `row` is no such node.
  NodeIndex rotation_of(int32_t row) const;

  /// *TRANSFORM: the axes of those nodes are those of a system of Deck::systems.
  void set_system(const std::vector<int32_t>& rows, const std::string& name);
  /// Empty: the basic frame.
  const std::string& system(int32_t row) const;

 private:
  NodeIndex add_point(int32_t row);

  const Model* model_;
  Deck* deck_;
  std::vector<int32_t> mesh_node_;
  std::map<int32_t, NodeIndex> point_of_;     // by row; also points on mesh nodes
  std::map<int32_t, NodeIndex> rotation_of_;  // by row
  std::vector<std::string> system_names_ = {""};
  std::vector<int32_t> system_of_;  // by row, empty where there is no *TRANSFORM
};

struct Reading {
  const Source& source;
  Ignore* ignore;
  Refusals* refusals;
  const Model* model;
  Sets* sets;
  Deck* deck;
  NodeMap* node_map = nullptr;                       // set once the mesh is built
  std::vector<double> initial;                       // temperature by row; empty: 0 everywhere
  std::map<std::string, std::string> surface_names;  // "use:FOLDED" -> name in the mesh
  std::map<std::string, std::vector<int32_t>> node_surfaces;        // the same -> rows
  std::vector<std::pair<size_t, std::vector<int32_t>>> dependents;  // of Deck::rigid, as rows
  std::map<std::string, std::string> material_names, system_names;  // folded -> name in the deck
  std::map<std::string, const Card*> amplitudes;                    // by folded name
  std::vector<int32_t> region_of_cell;                              // index into Mesh::regions
  int64_t faces = 0;                                                // of all surfaces
};

/// Calls body(use, card) for each card with one of those keys, use by use, in the order of the
/// deck. A refused card does not stop the reading; its NAME is lost.
template <class Body>
void for_each_card(const Reading& reading, std::initializer_list<std::string_view> keys,
                   const Body& body) {
  for (size_t use = 0; use < reading.model->uses().size(); ++use) {
    for (const Card& card : reading.model->uses()[use].scope->cards) {
      for (const std::string_view key : keys) {
        if (card.keyword().key != key) continue;
        if (reading.refusals->attempt([&] { body(use, card); })) continue;
        reading.refusals->lose(card.keyword().choice("NAME", ""));
      }
    }
  }
}

// Reading functions in call order. Each throws an InputError with the line for unsupported input.

/// *MATERIAL with *ELASTIC, *DENSITY, *EXPANSION -> Deck::materials.
void read_materials(Reading* reading);
/// *ORIENTATION -> Deck::systems.
void read_orientations(Reading* reading);
/// *SOLID SECTION -> regions, and with them the mesh: nodes, cells, numbers. Returns the mesh node
/// of each row.
std::vector<int32_t> build_mesh(Reading* reading);
/// *TRANSFORM -> Deck::systems and NodeMap.
void read_transforms(Reading* reading);
/// *INITIAL CONDITIONS, TYPE=TEMPERATURE -> Reading::initial and the materials' reference
/// temperature.
void read_initial_conditions(Reading* reading);
/// *SURFACE -> Mesh::surfaces and node sets.
void read_surfaces(Reading* reading);
/// *RIGID BODY, *COUPLING: reference nodes get a node index; dependents are kept in
/// Reading::dependents.
void read_rigid(Reading* reading);
/// *DISTRIBUTING COUPLING.
void read_distributing(Reading* reading);
/// *TIE.
void read_ties(Reading* reading);
/// *MASS, *ROTARY INERTIA with their elements.
void read_masses(Reading* reading);
/// The elements of a card's ELSET; InputError for cells and for types that do not begin with
/// `type`.
std::vector<PointElement> point_elements(Reading* reading, size_t use, const Card& card,
                                         std::string_view type);
/// *SPRING and *DASHPOT with their elements.
void read_springs(Reading* reading);
/// Dependents of rigid bodies, once all points are known.
void finish_rigid(Reading* reading);
/// *EQUATION and *MPC.
void read_equations(Reading* reading);
/// *BOUNDARY and loads of the model and of the steps.
void read_steps(Reading* reading);
/// *NSET -> Mesh::node_sets and Deck::sets.
void read_node_sets(Reading* reading);

/// *CYCLIC SYMMETRY MODEL: expands the deck to the full ring (cyclic.hpp).
void read_cyclic(Reading* reading);

/// Name in Deck::systems of an orientation; InputError at `spot` if it is missing.
std::string system_named(const Reading& reading, size_t use, const std::string& name, Spot spot);

/// Adds a surface of faces (cell, face of its traits), each once, under an unused name that begins
/// with `name`; returns the name.
using CellFaceId = std::pair<int32_t, int32_t>;
std::string add_surface(Reading* reading, const std::string& name,
                        const std::vector<CellFaceId>& faces);

/// Name in Mesh::surfaces of a *SURFACE. One of TYPE=NODE becomes the outer faces whose nodes all
/// belong to it; InputError when one of its nodes is in none of them.
std::string surface_named(Reading* reading, size_t use, const std::string& name, Spot spot);
std::string surface_of_nodes(Reading* reading, const std::vector<int32_t>& rows,
                             const std::string& name, Spot spot);
/// Rows of a *SURFACE of TYPE=NODE; null for others.
const std::vector<int32_t>* node_surface(const Reading& reading, size_t use,
                                         const std::string& name);

/// Mask of the DoFs first to last (1 to 6) in fields i and i + 1; without a last one only the
/// first.
DofMask dof_range(const Fields& fields, size_t i);

}  // namespace clatter::mesh::deck::abaqus
