// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Unfolds curved cells by moving nodes inside the solid.
//
// Mid-side nodes on a curved face are put onto the geometry; a thin cell at the face may fold (hard
// case G2). Each free node of a bad cell (corner or mid-side, not on the boundary of its block)
// moves to where the smallest scaled Jacobian of the cells around it, proved by Bezier coefficients
// (validity.hpp), is largest. Based on: Toulorge, Geuzaine, Remacle, Lambrechts, "Robust untangling
// of curvilinear meshes", J. Comput. Phys. 254 (2013); here node by node and by pattern search.
#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Stops when every cell's min det J / mean det J is at least `target` or nothing improves.
/// Straight good cells and the boundary are unchanged. Deterministic. Returns how many cells were
/// below the target before.
int64_t unfold_cells(Mesh& mesh, double target);

}  // namespace clatter::mesh
