// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What clatter-mesh does with a deck after its reader, for the fuzzing targets.
#include <sstream>
#include <string>

#include "core/base/units.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/msh/foreign_deck.hpp"
#include "mesh/deck/recipe/recipe.hpp"

namespace clatter::test {

/// SI, skin, proof of the cells, recipe.
inline void finish(mesh::deck::Deck deck) {
  const bool say_notes = false;
  mesh::deck::finish_deck(deck, unit_system_named("mm-t-s", "units"), "fuzz", say_notes);
  mesh::deck::recipe_of(deck).text();
}

/// The same of a mesh with groups.
inline void finish(mesh::ForeignMesh found) { finish(mesh::deck_of(std::move(found), "fuzz", {})); }

inline std::istringstream stream_of(const uint8_t* data, size_t size) {
  return std::istringstream(std::string(reinterpret_cast<const char*>(data), size));
}

}  // namespace clatter::test
