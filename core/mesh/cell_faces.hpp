// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// All faces of all cells, sorted so that equal faces are adjacent.
#include <cstdint>
#include <vector>

#include "core/mesh/boundary.hpp"

namespace clatter::mesh {

/// Reference to a face of a cell; nodes are looked up on demand, since there are many faces.
struct FaceRef {
  FaceKey key;
  int32_t block, cell, face;  // row in the block, face of its type
};

/// Sorted by key.
std::vector<FaceRef> all_faces(const Mesh& mesh);

BoundaryFace face_at(const Mesh& mesh, const FaceRef& face);

/// Calls visit(first, last) for each run of faces with the same key.
template <class Visit>
void for_each_face(const std::vector<FaceRef>& faces, const Visit& visit) {
  for (auto first = faces.begin(); first != faces.end();) {
    auto last = first + 1;
    while (last != faces.end() && last->key == first->key) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace clatter::mesh
