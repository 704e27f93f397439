// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pieces of a mesh that share no node (hard case F5).
#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

struct Pieces {
  int count = 0;
  int64_t coincident_nodes = 0;  // nodes of a piece with a node of another within 1e-9 of the box
};

/// Sets of cells that nodes connect, and how many nodes of different sets lie at one position, as
/// where two parts touch that nothing joins. Nodes without cells are not counted.
Pieces pieces_of(const Mesh& mesh);

}  // namespace clatter::mesh
