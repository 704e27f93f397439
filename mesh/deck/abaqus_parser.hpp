#pragma once
// First pass: the whole deck into tables and cards.
#include "mesh/deck/abaqus_scope.hpp"

namespace clatter::mesh::deck::abaqus {

/// Reads to the end. InputError for keywords that are not known here and that the user does not
/// ignore, for keywords out of place, and for tables with mistakes.
RawDeck parse(Source* source, Ignore* ignore);

}  // namespace clatter::mesh::deck::abaqus
