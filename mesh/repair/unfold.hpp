// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Unfolds curved cells by moving nodes inside the solid.
//
// Mid-side nodes on a curved face are put onto the geometry; a thin cell at the face may fold (hard
// case G2). Each free node of a bad cell (corner or mid-side, not on the boundary of its block)
// moves to where the smallest scaled Jacobian of the cells around it, proved by Bezier coefficients
// (validity.hpp), is largest. Based on: Toulorge, Geuzaine, Remacle, Lambrechts, "Robust untangling
// of curvilinear meshes", J. Comput. Phys. 254 (2013); here node by node and by pattern search.
// Nodes of the boundary that may slide along the geometry move so that -log sum exp(-30 ratio) of
// the cells around is largest, which a search node by node does not leave where two cells tie.
#include <functional>
#include <unordered_set>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// How nodes of the boundary may move.
struct Sliding {
  std::unordered_set<int32_t> nodes;  // that may
  /// The point of the node's face or curve that is nearest to x [m].
  std::function<Eigen::Vector3d(int32_t node, const Eigen::Vector3d& x)> onto;
};

/// Stops when every cell's min det J / mean det J is at least `target` or nothing improves.
/// Straight good cells are unchanged, and the boundary but for the nodes of `sliding`.
/// Deterministic. Returns how many cells were below the target before.
int64_t unfold_cells(Mesh& mesh, double target, const Sliding& sliding = {});

}  // namespace clatter::mesh
