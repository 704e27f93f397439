// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cells whose nodes are not in order: repeated nodes and left-handed numbering, which other
// programs run, and mid-side nodes in another order.
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Makes the cells of a deck such as this program has them, in three steps:
///   repeated nodes   a hexahedron of six distinct corners becomes a wedge, of five a pyramid, of
///                    four a tetrahedron, and likewise wedges and pyramids; a block that had such
///                    cells is followed by blocks of the new types
///   left-handed      det J < 0 at the centre: the nodes are those of the mirror image, which is
///                    positive everywhere if the cell was negative everywhere
///   mid-side nodes   of a cell that is folded because they lie on other edges than the format's
///                    order says: each goes to the edge in whose middle it lies
/// Surfaces follow: faces lose repeated nodes, faces of mirrored cells are turned outward.
/// @return what was done, after `where`; empty for most meshes.
/// InputError, after `where`, for repeated nodes that leave no such cell.
std::vector<Repair> repair_cells(Mesh& mesh, const std::string& where);

/// True when a cell has the same corner twice.
bool has_repeated_corners(const Mesh& mesh);

}  // namespace clatter::mesh::deck
