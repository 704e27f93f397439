#pragma once
// First pass: the whole deck into tables and cards.
#include "mesh/deck/abaqus/scope.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::abaqus {

/// Reads to the end. Keywords and element types that are not known here and that the user does not
/// ignore are refused and passed over. DeckRefused for keywords out of place, for tables with
/// mistakes, and for a deck that ends within a step, part or table. A step whose procedure is not
/// linear statics or frequencies, after one that is, is left out with all that follow it, and so
/// say the notes.
RawDeck parse(Source* source, Ignore* ignore, Refusals* refusals);

}  // namespace clatter::mesh::deck::abaqus
