// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// First pass: the entire deck into tables and cards.
#include "mesh/deck/abaqus/raw_deck.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::abaqus {

/// Reads to the end. Unknown keywords and element types that the user does not ignore are refused
/// and skipped. DeckRefused for misplaced keywords, for tables with errors, and for a deck that
/// ends within a step, part or table. A step whose procedure is not linear statics or frequencies,
/// after one that is, is skipped with all that follow it, with a note.
RawDeck parse(Source& source, Ignore& ignore, Refusals& refusals);

}  // namespace clatter::mesh::deck::abaqus
