// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Tables of nodes and elements.
#include "mesh/deck/abaqus/lines.hpp"
#include "mesh/deck/abaqus/local_system.hpp"
#include "mesh/deck/abaqus/raw_deck.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck::abaqus {

/// Reads the data lines of *NODE or *ELEMENT into `scope` and returns what follows them. InputError
/// for the first wrong line. `system`: of *SYSTEM.
Lines::Kind read_nodes(Lines& lines, Scope& scope, const LocalSystem& system, Ignore& ignore);
/// An unsupported element type is refused and then skipped like one that the user ignores. `notes`
/// gets a line for each type that is read as another one, by type.
Lines::Kind read_elements(Lines& lines, Scope& scope, Ignore& ignore, Refusals& refusals,
                          std::map<std::string, std::string>& notes);

/// All element types that are read.
std::vector<Listed> listed_elements();

}  // namespace clatter::mesh::deck::abaqus
