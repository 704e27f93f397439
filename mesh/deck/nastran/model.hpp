#pragma once
// From the cards to the Deck: what all steps share, and the steps in their order.
#include "mesh/deck/id_index.hpp"
#include "mesh/deck/nastran/bulk.hpp"
#include "mesh/deck/nastran/systems.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// The Deck that grows. A grid has a Place when a cell uses it, or when require() made it a point.
class Model {
 public:
  /// Fills in GRDSET, numbers the grids, brings their coordinates to the basic frame.
  Model(const Source& source, Bulk bulk, Refusals& refusals);

  /// Place of a grid; one without cells becomes a Point. InputError when there is no such GRID.
  NodeIndex require(int32_t grid, Origin origin);
  /// Place of a grid; -1 when nothing gave it one. InputError when there is no such GRID.
  NodeIndex find(int32_t grid, Origin origin) const;
  /// Places of a list, -1 never; grids without one are passed over, those that a THRU spans and
  /// that do not exist too. `make_points`: like require().
  std::vector<NodeIndex> node_indices(const IdList& list, Origin origin, bool make_points);
  /// Calls body(row of the grid) for each grid of the list.
  template <class Body>
  void for_each_grid(const IdList& list, Origin origin, const Body& body);
  bool is_node(NodeIndex node_index) const { return node_index < node_count; }
  /// Of a mesh node or a point.
  Eigen::Vector3d position(NodeIndex node_index) const;
  /// Number of its displacement system, 0: basic.
  int32_t displacement_system(NodeIndex node_index) const;
  /// Name of a system for the Deck, which has it from then on; empty for the basic one.
  std::string system_name(int32_t system, Origin origin);
  std::string where(Origin origin) const { return source.where(origin); }
  /// Lists that span others many times over could fill all memory: counts what they cost.
  void spend(int64_t effort, Origin origin);

  const Source& source;
  Refusals& refusals;
  Bulk bulk;
  IdIndex grids;  // row of a GRID
  Systems systems;
  Deck deck;
  std::vector<NodeIndex> index_of_row;
  std::vector<int32_t> hanging_rows;  // grids that complete_cells() added
  NodeIndex node_count = 0;
  IdIndex cells;  // numbered through all blocks of the mesh

 private:
  size_t row_of(int32_t grid, Origin origin) const;
  NodeIndex node_index_of(size_t row, Origin origin, bool make_points);

  std::vector<int32_t> row_of_index_;
  int64_t effort_ = 0;
  friend void build_mesh(Model& model);
};

/// Cells, nodes, regions, materials. Grids without cells get no place yet.
void build_mesh(Model& model);
/// Adds the middle nodes that cards leave out of a quadratic cell; rows of cells must be known.
void complete_cells(Model& model);
void build_regions(Model& model, const std::vector<int32_t>& properties);
/// RBE2, RBE3, MPC, CONM2: the grids they name get places.
void build_couplings(Model& model);
/// CELAS1 and CELAS2, after the couplings.
void build_springs(Model& model);
/// SPC, permanent constraints, ASET.
void build_supports(Model& model);
/// The supports of an SPC set (or SPCADD).
std::vector<Support> supports_of(Model& model, int32_t set, Origin origin);
/// SET1 and the surfaces and names that comments give.
void build_sets(Model& model);
/// Subcases with their loads.
void build_steps(Model& model);
/// Adds the face that a PLOAD4 means to a surface.
void add_face(Model& model, const RawPressure& raw, SurfaceBuilder& surface);
/// Says which grids were left out.
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
