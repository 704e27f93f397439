#pragma once
// Where triangles of the faces cut each other: chords of two round faces that leave no wall between
// them. No solid can be meshed within; the faces are named so that the user knows where to refine.
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter::mesh {

/// Two faces (tags, the smaller first) that cut each other.
struct SkinCrossing {
  int face, other;
  int count;              // edges of the one through triangles of the other
  Eigen::Vector3d position;  // of the first
};

/// `triangles`: by face tag, rows of three nodes. Triangles that share a node are not compared.
/// Ordered by face, then other.
std::vector<SkinCrossing> find_crossings(const RowMatrix& nodes,
                                         const std::map<int, IndexMatrix>& triangles);

/// "faces 1 and 4 at (1, 2, 3) (12 places), ..." of the first eight; empty for none.
std::string describe_crossings(const std::vector<SkinCrossing>& crossings);

}  // namespace clatter::mesh
