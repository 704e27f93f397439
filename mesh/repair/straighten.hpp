// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The last remedy for folded cells: straighter edges.
//
// A tetrahedron with straight edges is never folded, so pulling mid-side nodes toward the middle of
// their edges always ends in a valid mesh. But such a node leaves the geometry; the distance is
// returned, and the caller decides whether it is too large.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A boundary mid-side node that was pulled in.
struct PulledNode {
  int32_t node;
  double distance;  // from where it was, on the geometry [m]
  double edge;      // length of its edge [m]
};

/// Repeatedly halves the bow (mid-side node minus middle of its edge) of all edges of each tet10
/// whose min det J / mean det J is below `floor`, finally to zero. Corners are fixed.
/// Deterministic. Returns the nodes of the skin that moved, the farthest first.
std::vector<PulledNode> straighten_cells(Mesh& mesh, double floor);

}  // namespace clatter::mesh
