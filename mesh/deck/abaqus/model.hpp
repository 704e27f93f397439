// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Builds the Deck from the cards: shared state, and the functions in call order.
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/deck/abaqus/bolt_cut.hpp"
#include "mesh/deck/abaqus/face_rows.hpp"
#include "mesh/deck/abaqus/node_map.hpp"
#include "mesh/deck/abaqus/numbering.hpp"
#include "mesh/deck/abaqus/sets.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/ignore.hpp"
#include "mesh/deck/refusals.hpp"
#include "mesh/deck/shells.hpp"

namespace clatter::mesh::deck::abaqus {

/// The elements of two dimensions that are shells.
struct ShellParts {
  std::vector<int32_t> section_of;  // by thin element: one of *SHELL SECTION; -1: no shell
  std::vector<int32_t> regions;     // of each section, index into Mesh::regions; -1: refused
  std::vector<ShellHinge> hinges;   // those on nodes of solids
  bool are_marked = false;          // kShellMark
  std::vector<const IdSet*> sets;   // instead of sections, where they are marked

  int32_t section(int32_t thin) const {
    return thin < 0 || thin >= std::ssize(section_of) ? -1 : section_of[static_cast<size_t>(thin)];
  }
};

/// The Deck being built.
struct Model {
  /// Numbers all nodes and elements; InputError as Numbering.
  Model(const Source& deck_source, RawDeck raw, Ignore& ignored, Refusals& all_refusals);

  const Source& source;
  Ignore& ignore;
  Refusals& refusals;
  Deck deck;
  const Numbering numbering;
  Sets sets;
  NodeMap node_map;                                  // empty until the mesh is built
  std::vector<double> initial;                       // temperature by row; empty: 0 everywhere
  std::map<std::string, std::string> surface_names;  // "use:FOLDED" -> name in the mesh
  std::map<std::string, std::vector<int32_t>> node_surfaces;        // the same -> rows
  std::vector<std::pair<size_t, std::vector<int32_t>>> dependents;  // of Deck::rigid, as rows
  std::map<std::string, std::string> material_names, system_names;  // folded -> name in the deck
  // Of each *ORIENTATION: 1 to 3, the axis of its second line; 0: it has none.
  std::map<std::string, int> turned_axis;
  std::map<std::string, const Card*> amplitudes;  // by folded name
  bool is_calculix = false;                       // RawDeck::is_calculix
  std::optional<double> step_time, total_time;    // at the end of an open general static step
  std::vector<int32_t> region_of_cell;            // index into Mesh::regions
  int64_t faces = 0;                              // of all surfaces
  std::vector<BoltCut> cuts;                      // of *PRE-TENSION SECTION
  ShellParts shells;

  /// Whether an element is a shell beside the solids.
  bool is_shell(int32_t element) const { return shells.section(thin_row(element)) >= 0; }
  /// Index into Mesh::regions of a cell or shell; -1 for other elements.
  int32_t region_of(int32_t element) const {
    if (element < numbering.cells()) return region_of_cell[static_cast<size_t>(element)];
    const int32_t section = shells.section(thin_row(element));
    return section < 0 ? -1 : shells.regions[static_cast<size_t>(section)];
  }

 private:
  int32_t thin_row(int32_t element) const { return element - numbering.first_thin(); }
};

/// Calls body(use, card) for each card with one of those keys, use by use, in the order of the
/// deck. A refused card does not stop the others; its NAME is lost.
template <class Body>
void for_each_card(const Model& model, std::initializer_list<std::string_view> keys,
                   const Body& body) {
  for (size_t use = 0; use < model.numbering.uses().size(); ++use) {
    for (const Card& card : model.numbering.uses()[use].scope->cards) {
      for (const std::string_view key : keys) {
        if (card.keyword().key != key) continue;
        if (model.refusals.attempt([&] { body(use, card); })) continue;
        model.refusals.lose(card.keyword().choice("NAME", ""));
      }
    }
  }
}

// Each function refuses unsupported input with its line.

/// *MATERIAL with *ELASTIC, *DENSITY, *EXPANSION -> Deck::materials.
void build_materials(Model& model);
/// *ORIENTATION -> Deck::systems.
void build_systems(Model& model);
/// Cells, shells, nodes, regions. Nodes without cells get no node index yet.
void build_mesh(Model& model);
/// Elements with a *SHELL SECTION, or marked ones, that have a corner on no solid -> Model::shells.
void find_shells(Model& model);
/// Which nodes have rotations.
void let_shells_turn(Model& model);
/// Shells with their sections -> Mesh::shells, regions, Deck::shells.
void build_shells(Model& model);
/// Sides of a shell as CellFaceId: its own, and the other one.
inline constexpr int32_t kSpos = 0, kSneg = 1;
/// The face of a side of a shell.
void add_shell_faces(const Model& model, CellFaceId id, SurfaceBuilder& surface);
/// *SOLID SECTION -> regions of the mesh and of the deck, Model::region_of_cell. A part of a region
/// that rotates or has *NONSTRUCTURAL MASS becomes a region of its own.
void build_regions(Model& model);
/// *NONSTRUCTURAL MASS, after build_mesh() -> larger densities.
void build_nonstructural_mass(Model& model);
/// Elements of two dimensions that are faces of solids -> Mesh::surfaces, lines of their nodes ->
/// node sets; others with a section are refused.
void build_thin(Model& model);
/// The beam or truss of an element of one dimension with the section `card`; of three nodes two.
void add_beam(Model& model, const ThinElement& element, const Card& card);
/// *PRE-TENSION SECTION, before cells are copied: the cut's nodes get copies on one side.
void cut_bolts(Model& model);
/// The same cards, after build_surfaces() -> Deck::bolts.
void build_bolts(Model& model);
/// Temperatures of the cuts' copies; InputError for what the reference node of a bolt cannot have.
void finish_bolts(Model& model);
/// *TRANSFORM -> Deck::systems and NodeMap.
void build_transforms(Model& model);
/// *INITIAL CONDITIONS, TYPE=TEMPERATURE -> Model::initial and the materials' reference
/// temperature.
void build_initial_temperature(Model& model);
/// *SURFACE -> Mesh::surfaces and node sets.
void build_surfaces(Model& model);
/// *RIGID BODY, *COUPLING: reference nodes get a node index; dependents are kept in
/// Model::dependents.
void build_couplings(Model& model);
/// *DISTRIBUTING COUPLING.
void build_distributing(Model& model);
/// *TIE.
void build_ties(Model& model);
/// Bonded *CONTACT PAIR and general contact -> Deck::ties; other contact is refused.
void build_contacts(Model& model);
/// *MASS, *ROTARY INERTIA with their elements.
void build_masses(Model& model);
/// The elements of a card's ELSET; InputError for cells and for types that do not begin with
/// `type`.
std::vector<PointElement> point_elements(Model& model, size_t use, const Card& card,
                                         std::string_view type);
/// *SPRING and *DASHPOT with their elements.
void build_springs(Model& model);
/// The stiffness in the data lines from `first` on: one number, or with NONLINEAR a straight table
/// of forces; InputError for others.
double stiffness_of(const Card& card, size_t first, const Source& source);
/// CONN3D2 with *CONNECTOR SECTION and *CONNECTOR BEHAVIOR -> rigid couplings, equations, springs;
/// after build_couplings() and build_distributing().
void build_connectors(Model& model);
/// Dependents of rigid bodies, once all points are known.
void finish_couplings(Model& model);
/// *EQUATION and *MPC.
void build_equations(Model& model);
/// *BOUNDARY and loads of the model and of the steps.
void build_steps(Model& model);
/// *NSET -> Mesh::node_sets and Deck::sets.
void build_sets(Model& model);

/// *CYCLIC SYMMETRY MODEL: expands the deck to the full ring (cyclic.hpp).
void build_cyclic(Model& model);

/// Name in Deck::systems of an orientation; InputError at `origin` if it is missing.
std::string system_named(const Model& model, size_t use, const std::string& name, Origin origin);

/// Adds a surface of faces, each once, under an unused name that begins with `name`; returns the
/// name.
std::string add_surface(Model& model, const std::string& name,
                        const std::vector<CellFaceId>& faces);

/// Name in Mesh::surfaces of a *SURFACE. One of TYPE=NODE becomes the outer faces whose nodes all
/// belong to it; InputError when one of its nodes is in none of them.
std::string surface_named(Model& model, size_t use, const std::string& name, Origin origin);
std::string surface_of_nodes(Model& model, const std::vector<int32_t>& rows,
                             const std::string& name, Origin origin);
/// Faces of a *SURFACE of TYPE=ELEMENT, whether build_surfaces() has been called or not.
std::vector<CellFaceId> faces_named(Model& model, size_t use, const std::string& name,
                                    Origin origin);
/// Rows of a *SURFACE of TYPE=NODE; null for others.
const std::vector<int32_t>* node_surface(const Model& model, size_t use, const std::string& name);

/// Mask of the DoFs first to last (1 to 6) in fields i and i + 1; without a last one only the
/// first.
DofMask dof_range(const Fields& fields, size_t i);

}  // namespace clatter::mesh::deck::abaqus
