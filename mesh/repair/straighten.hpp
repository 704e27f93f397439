#pragma once
// The last means against folded cells: less bow.
//
// A tetrahedron with straight edges is never folded, so pulling middle nodes toward the middle of
// their edge ends in a valid mesh for certain. The price is that such a node leaves the geometry;
// how far is measured, and whoever calls decides whether that is too far.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A middle node of the boundary that was pulled in.
struct PulledNode {
  int32_t node;
  double distance;  // from where it was, on the geometry [m]
  double edge;      // length of its edge [m]
};

/// Halves the bow (middle node minus middle of its edge) of all edges of each tet10 whose
/// min det J / mean det J is below `floor`, again and again, at last to zero. Corners stay.
/// Deterministic. Returns the nodes of the skin that moved, the farthest first.
std::vector<PulledNode> straighten_cells(Mesh& mesh, double floor);

}  // namespace clatter::mesh
