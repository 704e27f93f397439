#pragma once
// Slivers inside the solid lifted by moving their inner nodes.
//
// A sliver is a flat cell with four good faces: Delaunay meshing leaves some (hard case G8). Its
// smallest dihedral angle grows when one of its nodes leaves the plane. Each inner node of a bad
// cell moves along a pattern of directions as long as the smallest angle of all cells around it
// rises; nodes on the boundary of a block stay. Source: Freitag, Ollivier-Gooch, "Tetrahedral mesh
// improvement using swapping and smoothing", Int. J. Numer. Meth. Engng 40 (1997), section 3; the
// search here is a plain pattern search in place of their active-set one.
#include "mesh/mesh.hpp"

namespace clatter::mesh {

/// Moves inner nodes of a linear (tet4) mesh until every cell's smallest dihedral angle is at least
/// `target_deg` or nothing improves. Never turns a cell inside out, never worsens the worst cell
/// around a node. Deterministic. Returns how many cells stay below.
int64_t lift_slivers(Mesh& mesh, double target_deg);

}  // namespace clatter::mesh
