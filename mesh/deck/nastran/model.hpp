// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Builds the Deck from the cards: shared state, and the functions in call order.
#include <optional>
#include <span>
#include <string_view>

#include "core/mesh/boundary.hpp"
#include "mesh/deck/id_index.hpp"
#include "mesh/deck/ignore.hpp"
#include "mesh/deck/nastran/node_map.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"
#include "mesh/deck/nastran/systems.hpp"
#include "mesh/deck/refusals.hpp"
#include "mesh/deck/shells.hpp"

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
  /// True for a grid of cells that the user ignores.
  bool is_lost(int32_t grid) const;
  /// A new point, numbered above all grids.
  NodeIndex add_point(const Eigen::Vector3d& at, Origin origin);
  /// Direction 0 to 5 of a grid, 0 of a scalar point. InputError when a grid has kScalar.
  int direction_at(int32_t grid, int direction, Origin origin) const;
  /// Boundary faces of the mesh; made at the first call.
  const BoundaryFaces& boundary();
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
  NodeMap node_map;                // empty until the mesh is built
  IdIndex cells;                   // numbered across all blocks of the mesh
  std::optional<IdIndex> skins;    // row of a two-dimensional cell in raw.skins; made when needed
  std::optional<IdIndex> shells;   // the same of raw.shell_cells
  std::vector<ShellHinge> hinges;  // shells on nodes of solids
  int64_t lost_loads = 0;          // forces on grids of ignored cells
  std::map<NodeIndex, NodeIndex> hung;  // point of a mass beside a node of solids -> that node

 private:
  size_t row_of(int32_t grid, Origin origin) const;
  NodeIndex require_row(size_t row, Origin origin);

  int64_t effort_ = 0;
  std::optional<BoundaryFaces> boundary_;
};

/// Leaves out the cells of fluids if the user ignores them; else refuses them.
void leave_out_fluids(Model& model, Ignore& ignore);
/// Cells, nodes, regions. Grids without cells get no node index yet.
void build_mesh(Model& model, const Ignore& ignore);
/// Moves those two-dimensional cells that are shells, which have a corner on no solid, to
/// raw.shell_cells and marks their rows in `mesh_node`.
void find_shells(Model& model, const Ignore& ignore, std::vector<int32_t>& mesh_node);
/// raw.shell_cells with their PSHELL -> Mesh::shells, regions, Deck::shells.
void build_shells(Model& model);
/// Node indices of a shell.
ShellFace face_of_shell(const Model& model, const RawSkin& raw);
/// Adds the mid-side nodes that cards omit from a quadratic cell to the grids and to `mesh_node`
/// (of each row, NodeMap::kNone or not); needs the rows of cells. Returns their rows.
std::vector<int32_t> complete_cells(Model& model, std::vector<int32_t>& mesh_node);
/// PSOLID -> regions of the mesh and of the deck; `properties` are their numbers.
void build_regions(Model& model, const std::vector<int32_t>& properties);
/// The card of a material; empty for none.
std::string_view material_card(const Model& model, int32_t id);
/// MAT1 and MAT9, or MAT1, MAT2 and MAT8 of sheets -> Deck::materials. Name of the material; empty
/// when the deck of solids has none at all. InputError at `origin` if it is missing or another one.
/// @param property for messages: PSOLID, or another card with its number.
std::string use_material(Model& model, std::string_view property, int32_t id, Origin origin);
/// The same material, which raw.materials has, for properties beside regions.
Material material_of(const Model& model, int32_t id);
/// RBE2, RBE3 and what is the same: their grids get node indices.
void build_couplings(Model& model);
/// RBAR, RBE1 with independent DoFs at several grids, RROD -> equations.
void build_links(Model& model);
/// CONM2.
void build_masses(Model& model);
/// MPC of the chosen set.
void build_equations(Model& model);
/// CELAS, CMASS with their PELAS, PMASS.
void build_springs(Model& model);
/// CBUSH with their PBUSH, CGAP with their PGAP -> springs.
void build_bushes(Model& model);
/// CFAST with their PFAST, CWELD with their PWELD -> springs, masses.
void build_fasteners(Model& model);
/// CBAR, CBEAM, CROD, CONROD, CTUBE with their properties -> beams.
void build_bars(Model& model);
/// CONM1 and the DMIG of K2GG and M2GG.
void build_matrices(Model& model);
/// BGSET -> ties.
void build_glue(Model& model);
/// CQUAD4 and the like that are no shells: faces of solids -> Mesh::surfaces; others are refused,
/// or left out by the user.
void build_skins(Model& model, Ignore& ignore);
/// What hangs on grids of ignored cells alone: refused together, or dropped by the user.
void drop_loose(Model& model, Ignore& ignore);
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
/// Adds the accelerations of a card, times `factor`, to those of the nodes of a step, and the
/// forces on masses and mass matrices.
void add_accelerations(Model& model, Step& step, const RawAcceleration& raw, double factor);
/// A face that a load acts on.
struct LoadedFace {
  FaceType type = FaceType::kTri3;
  std::array<int32_t, kMaxFaceNodes> nodes{};  // outward
  int first = 0;                               // the corner that is G1
  bool outward = true;   // the right-hand normal of the card's grids, if it lists all
  bool on_solid = true;  // else only its corners belong to solids: of PLOAD
};

/// The face of a cell that G1 and G3 or G4 of PLOAD4 define.
LoadedFace face_of_cell(Model& model, const RawPressure& raw);
/// The face of a cell with three of its corners.
LoadedFace face_of_corners(Model& model, const RawPressure& raw,
                           const std::array<int32_t, 3>& grids);
/// The face on the grids of a PLOAD, on a solid or not.
LoadedFace face_of_grids(Model& model, const RawPressure& raw);
/// The face of a solid on the boundary with these corners, if there is one.
std::optional<LoadedFace> boundary_face(Model& model, std::span<const int32_t> grids,
                                        Origin origin);
/// A pressure on a face; on one of a shell along its normal.
struct SkinLoad {
  RawPressure pressure;
  LoadedFace face;
};
/// Shells of these numbers, and faces of solids on which two-dimensional cells of these numbers
/// lie.
std::vector<SkinLoad> loads_on_skins(Model& model, const RawSkinPressure& raw);
/// Forces on the nodes of a pressure that varies over a face or acts along a vector.
std::vector<Step::NodalForce> forces_on_face(Model& model, const RawPressure& raw,
                                             const LoadedFace& face);

/// Adds a term unless its coefficient is 0.
void add_term(std::vector<Equation::Term>& terms, NodeIndex node_index, int direction,
              double coefficient);
/// Terms of `factor` times the displacement (direction 0 to 2) or rotation (3 to 5) of a grid along
/// its own axes. The largest one is the first, which in an equation is the dependent one.
std::vector<Equation::Term> terms_along(Model& model, NodeIndex node_index, int direction,
                                        double factor, Origin origin);
/// Notes which grids were skipped.
void count_unused(Model& model);
/// Lumped without PARAM, COUPMASS, as Nastran has it.
void choose_mass(Model& model);
/// Damping of bushes by velocity is passed over.
void pass_damping(Model& model);
/// PARAM, ALPHA1 and ALPHA2, for the recipe to offer; G, the loss factor of all stiffness.
void take_damping(Model& model);
/// A remark: what the solution changes.
void note_solution(Model& model);

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
