// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY: nodes and elements that are generated from others.
#include "mesh/deck/abaqus/local_system.hpp"
#include "mesh/deck/abaqus/raw_deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// Adds what the card generates to `scope`, from nodes, elements and sets before it. `system`: of
/// *SYSTEM. InputError for missing ones and for too many.
void generate(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
              Ignore& ignore);

/// Numbers of the members of a set, each once, ascending. InputError at `origin` when there is none
/// of that name, or when it holds itself.
std::vector<int32_t> numbers_of_set(const Scope& scope, const IdSets& sets, const std::string& name,
                                    const Source& source, Origin origin);

}  // namespace clatter::mesh::deck::abaqus
