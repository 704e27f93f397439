// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *NSET, *ELSET.
#include "mesh/deck/abaqus/lines.hpp"
#include "mesh/deck/abaqus/raw_deck.hpp"
#include "mesh/deck/ignore.hpp"

namespace clatter::mesh::deck::abaqus {

/// Reads the data lines of *NSET or *ELSET into `scope` and returns what follows them. InputError
/// for the first wrong line.
Lines::Kind read_set(Lines& lines, Scope& scope, Ignore& ignore);

}  // namespace clatter::mesh::deck::abaqus
