// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Builds the Deck from the cards: shared state, and the functions in call order.
#include "mesh/deck/id_index.hpp"
#include "mesh/deck/nastran/node_map.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"
#include "mesh/deck/nastran/systems.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// The Deck being built. A grid has a node index if a cell uses it, or if require() made it a
/// point.
class Model {
 public:
  /// Applies GRDSET, indexes the grids, transforms their coordinates to the basic frame.
  Model(const Source& source, RawDeck raw, Refusals& refusals);

  /// Node index of a grid; one without cells becomes a Point. InputError if there is no such GRID.
  NodeIndex require(int32_t grid, Origin origin);
  /// Node index of a grid; -1 if it has none. InputError if there is no such GRID.
  NodeIndex find(int32_t grid, Origin origin) const;
  /// Node indices of a list, never -1; skips grids without one, and missing ones within a THRU.
  /// `make_points`: like require().
  std::vector<NodeIndex> node_indices(const IdList& list, Origin origin, bool make_points);
  /// Calls body(row of the grid) for each grid of the list.
  template <class Body>
  void for_each_grid(const IdList& list, Origin origin, const Body& body);
  /// Name of a system, which is added to the Deck; empty for the basic one.
  std::string system_name(int32_t system, Origin origin);
  /// Counts the effort of nested lists, which could otherwise exhaust the memory.
  void spend(int64_t effort, Origin origin);

  const Source& source;
  Refusals& refusals;
  RawDeck raw;
  IdIndex grids;  // row of a GRID
  Systems systems;
  Deck deck;
  NodeMap node_map;  // empty until the mesh is built
  IdIndex cells;     // numbered across all blocks of the mesh

 private:
  size_t row_of(int32_t grid, Origin origin) const;
  NodeIndex require_row(size_t row, Origin origin);

  int64_t effort_ = 0;
};

/// Cells, nodes, regions. Grids without cells get no node index yet.
void build_mesh(Model& model);
/// Adds the mid-side nodes that cards omit from a quadratic cell to the grids and to `mesh_node`
/// (of each row, NodeMap::kNone or not); needs the rows of cells. Returns their rows.
std::vector<int32_t> complete_cells(Model& model, std::vector<int32_t>& mesh_node);
/// PSOLID -> regions of the mesh and of the deck; `properties` are their numbers.
void build_regions(Model& model, const std::vector<int32_t>& properties);
/// MAT1, MAT9 -> Deck::materials. Name of the material; empty when the deck has none at all.
/// InputError at `origin` if it is missing.
std::string use_material(Model& model, int32_t id, Origin origin);
/// RBE2, RBE3: their grids get node indices.
void build_couplings(Model& model);
/// CONM2.
void build_masses(Model& model);
/// MPC of the chosen set.
void build_equations(Model& model);
/// CELAS1, CELAS2 with their PELAS.
void build_springs(Model& model);
/// SPC, permanent constraints, ASET.
void build_supports(Model& model);
/// The supports of an SPC set (or SPCADD).
std::vector<Support> supports_of(Model& model, int32_t set, Origin origin);
/// SET1 -> Mesh::node_sets and Deck::sets.
void build_sets(Model& model);
/// Surfaces from comments -> Mesh::surfaces.
void build_surfaces(Model& model);
/// TEMPERATURE(INITIAL) -> the materials' reference temperature.
void build_initial_temperature(Model& model);
/// Subcases with their loads.
void build_steps(Model& model);
/// Shells that are faces of solids -> Mesh::surfaces; others with a property are refused.
void build_skins(Model& model);
/// Adds the face of a PLOAD4 to a surface.
void add_face(Model& model, const RawPressure& raw, SurfaceBuilder& surface);
/// Adds a term unless its coefficient is 0.
void add_term(std::vector<Equation::Term>& terms, NodeIndex node_index, int direction,
              double coefficient);
/// Notes which grids were skipped.
void count_unused(Model& model);

template <class Body>
void Model::for_each_grid(const IdList& list, Origin origin, const Body& body) {
  for (const IdRange& range : list) {
    if (!range.is_range) {
      spend(1, origin);
      body(row_of(range.first, origin));
      continue;
    }
    spend(grids.effort(range.first, range.last), origin);
    grids.for_each(range.first, range.last, range.step,
                   [&](int32_t row) { body(static_cast<size_t>(row)); });
  }
}

}  // namespace clatter::mesh::deck::nastran
