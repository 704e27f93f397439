// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Intersecting surface triangles: chords of two curved faces that leave no wall between them. No
// solid can be meshed inside; the faces are named so that the user knows where to refine.
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter::mesh {

/// Two intersecting faces (tags, the smaller first).
struct SkinCrossing {
  int face, other;
  int count;                 // edges of one that pierce triangles of the other
  Eigen::Vector3d position;  // of the first
};

/// `triangles`: by face tag, rows of three nodes. Triangles that share a node are not compared.
/// Ordered by face, then other.
std::vector<SkinCrossing> find_crossings(const RowMatrix& nodes,
                                         const std::map<int, IndexMatrix>& triangles);

/// "faces 1 and 4 at (1, 2, 3) (12 intersections), ..." for the first eight; empty for none.
std::string describe_crossings(const std::vector<SkinCrossing>& crossings);

}  // namespace clatter::mesh
