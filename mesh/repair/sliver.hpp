// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Removal of slivers from a linear tetrahedral mesh.
//
// A sliver is a flat cell with four good faces: Delaunay meshing leaves some (hard case G8), inside
// and, where a thin plate has the same triangles on both sides, across the plate. Two remedies,
// each applied only if the worst affected cell improves:
//  - an inner node moves along a pattern of directions to where the smallest dihedral angle around
//    it is largest;
//  - an inner edge of the sliver gets a new node in its middle, or both crossing diagonals get one
//    in common, which removes the sliver; then the new node moves as above.
// The boundary of each block keeps its nodes and triangles.
// Based on: Freitag, Ollivier-Gooch, "Tetrahedral mesh improvement using swapping and
// smoothing", Int. J. Numer. Meth. Engng 40 (1997), section 3; Klingner, Shewchuk, "Aggressive
// tetrahedral mesh improvement", Proc. 16th Int. Meshing Roundtable (2007), section 3.
#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

struct SliverReport {
  int64_t before = 0, after = 0;  // cells below the target
  int64_t new_nodes = 0;          // appended to Mesh::nodes
};

/// Improves a tet4 mesh until every cell's smallest dihedral angle is at least `target_deg` or
/// nothing improves. Never inverts a cell. Deterministic. Surfaces of the mesh stay valid, cells
/// are renumbered within their block. InputError for another cell type.
SliverReport lift_slivers(Mesh& mesh, double target_deg);

/// Divides cells that have two faces on the boundary with more than a right angle between them:
/// both would lie in one curved face, and once curved to it such a cell is flat there. The opposite
/// edge gets a node, placed as above. Only where no cell gets an angle below `least_deg`. tet4
/// meshes; returns how many were divided.
int64_t split_blunt_corners(Mesh& mesh, double least_deg);

}  // namespace clatter::mesh
