// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// First pass: the entire deck as written.
#include "mesh/deck/ignore.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::nastran {

/// Reads executive and case control, then the bulk data to ENDDATA. Unknown cards that the user
/// does not ignore are refused and skipped. DeckRefused when cards have errors, because others may
/// name them; a note when the deck ends without ENDDATA.
RawDeck parse(Source& source, Ignore& ignore, Refusals& refusals);

}  // namespace clatter::mesh::deck::nastran
