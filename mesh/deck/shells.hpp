// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shells of a deck as cells of its mesh, for both readers.
#include <functional>
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"
#include "mesh/deck/refusals.hpp"
#include "mesh/deck/shell_joints.hpp"
#include "mesh/deck/shell_shape.hpp"

namespace clatter::mesh::deck {

/// A shell as a deck has it.
struct ShellCell {
  std::string kind;  // CQUAD4, S8R
  int32_t id = 0;
  int32_t region = 0;                              // index into Mesh::regions
  ShellFace face;                                  // its side is outward; values: thickness
  double offset = 0.0;                             // from its nodes to its mid-surface, outward
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // direction 1 of its material, or 0
};

/// Adds shells to Deck::mesh: those with a repeated corner as triangles, turned where neighbours
/// have other sides (orient_shells.hpp) but not those of layers; with a thickness of their own
/// where it is not that of the region in Deck::shells. Refuses those that cannot be shells; notes
/// what it did.
/// @param where file and line of cell i.
/// @return those on nodes of solids.
std::vector<ShellHinge> add_shells(Deck& deck, const std::vector<ShellCell>& cells,
                                   const std::function<std::string(size_t)>& where,
                                   Refusals& refusals);

}  // namespace clatter::mesh::deck
