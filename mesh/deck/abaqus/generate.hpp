// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY: nodes and elements that are generated from others. *NMAP:
// nodes that are moved.
#include "mesh/deck/abaqus/local_system.hpp"
#include "mesh/deck/abaqus/raw_deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// Adds what the card generates to `scope`, from nodes, elements and sets before it. `system`: of
/// *SYSTEM. InputError for missing ones and for too many.
void generate(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
              Ignore& ignore);

}  // namespace clatter::mesh::deck::abaqus
