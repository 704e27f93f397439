// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/deck/abaqus/reader.hpp"
#include "mesh/deck/beam_ends.hpp"
#include "mesh/deck/cell_repair.hpp"
#include "mesh/deck/nastran/reader.hpp"

namespace clatter::mesh::deck {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool is_nastran(const std::string& extension) {
  return extension == ".bdf" || extension == ".nas" || extension == ".dat" || extension == ".fem";
}

/// The units and highest numbers of the deck; readers may have noted higher numbers of what they
/// do not keep.
void note_origin(Deck& deck, const UnitSystem& units) {
  DeckOrigin& origin = deck.mesh.deck;
  origin.units = units.name;
  for (const int32_t id : deck.mesh.node_ids)
    origin.largest_node = std::max(origin.largest_node, id);
  for (const Point& point : deck.points)
    origin.largest_node = std::max(origin.largest_node, point.id);
  for (const CellBlock& block : deck.mesh.cells)
    for (const int32_t id : block.ids)
      origin.largest_element = std::max(origin.largest_element, id);
  for (const ShellBlock& block : deck.mesh.shells)
    for (const int32_t id : block.ids)
      origin.largest_element = std::max(origin.largest_element, id);
}

}  // namespace

bool is_deck(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".inp" || is_nastran(extension);
}

Deck read_deck(const std::filesystem::path& path, const UnitSystem& units,
               const ReadOptions& options) {
  const std::string extension = extension_of(path);
  if (!is_deck(path))
    throw InputError(
        fmt::format("{}: found extension '{}', expected .inp, .bdf, .nas, .dat or .fem",
                    path.string(), extension));
  Deck deck = is_nastran(extension) ? read_nastran(path, options) : read_abaqus(path, options);
  if (options.mass) {
    deck.mass = *options.mass;
  } else if (deck.mass == MassForm::kLumped) {
    deck.notes.push_back(
        fmt::format("{}: lumped mass of the cells, as the deck's program makes it; --mass "
                    "consistent changes it",
                    path.string()));
  }
  const bool say_notes = options.contents == nullptr;  // else they are rows of the table
  finish_deck(deck, units, path.string(), say_notes);
  return deck;
}

void finish_deck(Deck& deck, const UnitSystem& units, const std::string& where, bool say_notes) {
  if (deck.mesh.cell_count() == 0 && deck.mesh.shells.empty() && deck.springs.empty() &&
      deck.matrices.empty() && deck.beams.empty())
    throw InputError(
        fmt::format("{}: found no solid cells, shells, beams and springs, expected some", where));
  settle_beam_ends(deck);
  std::ranges::move(repair_cells(deck.mesh, where), std::back_inserter(deck.renumbered));
  for (const Support& retained : deck.retained)
    if (!retained.system.empty())
      deck.notes.push_back(fmt::format(
          "{}: retained along the axes of system {}, the deck's own: exports for the rest "
          "of the deck have the same components, others directions",
          retained.where, retained.system));
  if (say_notes) {
    for (const Repair& one : deck.renumbered) warn(one.text);
    for (const std::string& one : deck.notes) warn(one);
  }
  convert_units(deck, units);
  note_origin(deck, units);
  deck.mesh.surfaces["skin"] = skin_of(boundary_faces(deck.mesh), deck.mesh.shells);
  check_structure(deck.mesh, where);
  const ValidityReport validity = check_validity(deck.mesh);
  if (!validity.invalid.empty())
    throw InputError(fmt::format(
        "{}: {} of {} cells are inverted or folded, expected det J > 0: {}", where,
        validity.invalid.size(), deck.mesh.cell_count(), describe_invalid(validity, 3)));
}

}  // namespace clatter::mesh::deck
