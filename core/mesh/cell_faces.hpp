#pragma once
// All faces of all cells, equal ones side by side.
#include <cstdint>
#include <vector>

#include "core/mesh/boundary.hpp"

namespace clatter::mesh {

/// Where a face stands; its nodes are looked up when needed, since there are many faces.
struct FacePlace {
  FaceKey key;
  int32_t block, cell, face;  // row in the block, face of its type
};

/// Ordered by key.
std::vector<FacePlace> all_faces(const Mesh& mesh);

BoundaryFace face_at(const Mesh& mesh, const FacePlace& place);

/// Calls visit(first, last) for each run of faces with the same key.
template <class Visit>
void for_each_face(const std::vector<FacePlace>& faces, const Visit& visit) {
  for (auto first = faces.begin(); first != faces.end();) {
    auto last = first + 1;
    while (last != faces.end() && last->key == first->key) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace clatter::mesh
