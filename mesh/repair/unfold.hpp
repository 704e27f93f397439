#pragma once
// Curved cells unfolded by moving the nodes inside the solid.
//
// Middle nodes on a round face are put onto the geometry; a thin cell behind may fold (hard case
// G2). Each free node of a bad cell (corner or middle of an edge, not on the boundary of its block)
// moves to where the smallest scaled Jacobian of the cells around it, proved by Bezier coefficients
// (validity.hpp), is largest. Source of the idea: Toulorge, Geuzaine, Remacle, Lambrechts, "Robust
// untangling of curvilinear meshes", J. Comput. Phys. 254 (2013); here node by node and by plain
// search.
#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Works until every cell's min det J / mean det J is at least `target` or nothing gets better.
/// Straight good cells and the boundary stay as they are. Deterministic. Returns how many cells
/// were below the target before.
int64_t unfold_cells(Mesh& mesh, double target);

}  // namespace clatter::mesh
