// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nodes of shells, which have rotations, among those of solids, which have none.
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"
#include "mesh/deck/refusals.hpp"

namespace clatter::mesh::deck {

/// A shell with nodes of solids.
struct ShellHinge {
  std::string where;
  std::string what;  // "shell edge 5-6 of CQUAD4 10"
  std::vector<NodeIndex> nodes;
};

/// By node of the mesh: whether shells have it, so that it has rotations.
std::vector<bool> turning_flags(const Mesh& mesh);

/// Refuses shells on nodes of solids, unless a coupling, a support or an equation has the rotation
/// of each of these nodes: hinges.
void refuse_hinges(const Deck& deck, const std::vector<ShellHinge>& hinges, Refusals& refusals);

}  // namespace clatter::mesh::deck
