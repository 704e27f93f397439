// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/part_file.hpp"

namespace clatter::mesh {
namespace {

const keys::Keys<DeckSource>& deck_keys() {
  static const keys::Keys<DeckSource> keys(
      "deck", "a deck of another program with its own cells", [](auto& key, DeckSource& deck) {
        key.path("source", deck.source,
                 "deck of Nastran, Abaqus or CalculiX, or mesh of Gmsh, MED, UNV or ANSYS")
            .required();
        key.units("units", deck.units, "units of the deck, which names none").required();
        key.texts("ignore", deck.ignore, "names of cards or keywords that are passed over");
        key.choice("mass", deck.mass, {"as in the deck", "consistent", "lumped"},
                   "mass matrix of the fe.toml that --recipe writes");
      });
  return keys;
}

const keys::Keys<LocalSize>& local_keys() {
  static const keys::Keys<LocalSize> keys(
      "local", "finer cells on a surface", [](auto& key, LocalSize& local) {
        key.text("surface", local.surface, "name of a surface of the part, or of [surface.NAME]")
            .required();
        key.number("factor", local.factor, {0.0, 1.0, true},
                   "size on it, as a factor of the element size");
        key.integer(
            "elements_per_turn", local.elements_per_turn, {0.0, 1000.0},
            "elements on a full circle of the surface's smallest radius; 0 for no such limit");
        key.number("growth", local.growth, {0.0, 10.0},
                   "growth of the size per distance from the surface; 0 for Gmsh's default");
        key.check([](const Config& table, LocalSize& l) {
          if (!table.has("factor") && l.elements_per_turn == 0)
            table.fail("factor", "give factor or elements_per_turn");
        });
      });
  return keys;
}

const keys::Keys<MeshSettings>& settings_keys() {
  static const keys::Keys<MeshSettings> keys(
      "mesh", "how fine the mesh is", [](auto& key, MeshSettings& mesh) {
        key.number("element_size_mm", mesh.element_size, Range::positive(),
                   "size of the elements, the one number that refines everything");
        key.number("min_size_mm", mesh.min_size, Range::not_negative(),
                   "lower limit of sizes that follow from curvature");
        key.integer("elements_per_turn", mesh.elements_per_turn, {0.0, 1000.0},
                    "elements on a full circle where surfaces are curved; 0 ignores curvature");
        key.number("min_dihedral_deg", mesh.min_dihedral_deg, {0.0, 60.0},
                   "aim: cells with a smaller angle are meshed again, with finer neighbours")
            .unconverted();
        key.number("min_scaled_jacobian", mesh.min_scaled_jacobian, {0.0, 0.9},
                   "aim: curved cells below are unfolded");
        key.integer("refine_passes", mesh.refine_passes, {0.0, 20.0},
                    "most passes of refinement toward the aims");
        key.number("max_cells", mesh.max_cells, Range::positive(),
                   "a part that is predicted to get more is refused before it is meshed");
        key.flag("accept_poor_cells", mesh.accept_poor_cells,
                 "whether cells far below the aims give a warning instead of a refusal");
        key.tables("local", mesh.local, local_keys());
        key.check([](const Config& table, MeshSettings& m) {
          if (m.min_size > m.element_size)
            table.fail("min_size_mm", "expected at most element_size_mm");
        });
      });
  return keys;
}

}  // namespace

const keys::Keys<PartFile>& part_keys() {
  static const keys::Keys<PartFile> keys(
      "mesh.toml", "the geometry of a part and its mesh", [](auto& key, PartFile& part) {
        key.text("name", part.name, "name of the part").required();
        key.part(part.shape, shape_keys());
        key.table("deck", part.deck, deck_keys())
            .needs("kind", "deck")
            .required_with("kind", "deck");
        key.table("mesh", part.mesh, settings_keys())
            .needs("kind",
                   {"block", "head", "piston", "rod", "box", "cylinder", "pan", "cad", "sheet"},
                   "a deck has its own cells");
      });
  return keys;
}

}  // namespace clatter::mesh
