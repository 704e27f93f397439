// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Conversion of a deck to SI.
#include "core/base/units.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Converts everything in the deck to SI; temperatures are unchanged.
void convert_units(Deck& deck, const UnitSystem& units);

}  // namespace clatter::mesh::deck
