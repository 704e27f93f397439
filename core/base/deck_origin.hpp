// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a mesh from a deck of another program knows of that deck, so that exports fit beside the
// rest of it.
#include <cstdint>
#include <string>

namespace clatter {

class H5File;

struct DeckOrigin {
  std::string units;            // name of a UnitSystem; empty: not from a deck
  int32_t largest_node = 0;     // highest number of a node or point of the deck
  int32_t largest_element = 0;  // highest number of an element

  bool known() const { return !units.empty(); }
};

/// Attributes deck_units, deck_largest_node, deck_largest_element of the root; nothing when it is
/// not known.
void write_deck_origin(H5File& file, const DeckOrigin& deck);
/// Not known in files without them. InputError for unknown units and numbers below zero.
DeckOrigin read_deck_origin(const H5File& file);

}  // namespace clatter
