// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cells that other programs run although their nodes are not in order: repeated nodes, left-handed
// numbering.
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// Makes the cells of a deck such as this program has them, in two steps:
///   repeated nodes   a hexahedron of six distinct corners becomes a wedge, of five a pyramid, of
///                    four a tetrahedron, and likewise wedges and pyramids; a block that had such
///                    cells is followed by blocks of the new types
///   left-handed      det J < 0 at the centre: the nodes are those of the mirror image, which is
///                    positive everywhere if the cell was negative everywhere
/// Surfaces follow: faces lose repeated nodes, faces of mirrored cells are turned outward.
/// @return what was done, a sentence each; empty for most meshes.
/// InputError, after `where`, for repeated nodes that leave no such cell.
std::vector<std::string> repair_cells(Mesh& mesh, const std::string& where);

}  // namespace clatter::mesh::deck
