#pragma once
// A deck in SI.
#include "core/base/units.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Brings everything in the deck to SI; temperatures stay as they are.
void convert_units(Deck& deck, const UnitSystem& units);

}  // namespace clatter::mesh::deck
