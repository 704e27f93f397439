// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What bars of a deck cannot do here: said once, for both readers.
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Takes the torsion of bars between two nodes of solids away, which turn freely; notes how many
/// bars end on such nodes, as hinges, and that bars do not expand in steps with temperatures.
void settle_beam_ends(Deck& deck);

}  // namespace clatter::mesh::deck
