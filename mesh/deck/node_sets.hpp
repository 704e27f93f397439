// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Node sets of a deck, and lists without repetitions.
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Sorts ascending and drops repetitions.
void sort_unique(std::vector<int32_t>& values);

/// True when the deck has a set of that name, of nodes or with points.
bool has_node_set(const Deck& deck, const std::string& name);

/// Adds a set of nodes and points: its mesh nodes become Mesh::node_sets[name], and if it contains
/// points all of it is Deck::sets[name].
void add_node_set(Deck& deck, const std::string& name, std::vector<NodeIndex> node_indices);

}  // namespace clatter::mesh::deck
