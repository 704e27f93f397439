// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Members of sets while the deck is read, by their numbers.
#include "mesh/deck/abaqus/raw_deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// Numbers of the members of a set, each once, ascending. InputError at `origin` when there is none
/// of that name, or when it holds itself.
std::vector<int32_t> numbers_of_set(const Scope& scope, const IdSets& sets, const std::string& name,
                                    const Source& source, Origin origin);

}  // namespace clatter::mesh::deck::abaqus
