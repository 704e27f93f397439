// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/cell_faces.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace clatter::mesh {

namespace {

template <class Visit>
void for_each_face_of_cells(const Mesh& mesh, const Visit& visit) {
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const IndexMatrix& nodes = mesh.cells[b].nodes;
    const std::span<const CellFace> faces = traits(mesh.cells[b].type).faces;
    for (Eigen::Index c = 0; c < nodes.rows(); ++c)
      for (size_t f = 0; f < faces.size(); ++f) {
        std::array<int32_t, 4> corners{};
        for (int i = 0; i < traits(faces[f].type).corners; ++i)
          corners[i] = nodes(c, faces[f].nodes[i]);
        visit(FaceRef{face_key(faces[f].type, corners), static_cast<int32_t>(b),
                      static_cast<int32_t>(c), static_cast<int32_t>(f)});
      }
  }
}

bool before(const FaceRef& a, const FaceRef& b) { return a.key < b.key; }

}  // namespace

BoundaryFace face_at(const Mesh& mesh, const FaceRef& ref) {
  const CellBlock& block = mesh.cells[ref.block];
  const CellFace& local = traits(block.type).faces[ref.face];
  BoundaryFace face{local.type, {}, ref.block, ref.cell};
  face.ids.fill(-1);
  for (size_t i = 0; i < static_cast<size_t>(traits(local.type).nodes); ++i)
    face.ids[i] = block.nodes(ref.cell, local.nodes[i]);
  return face;
}

// In linear time up to the few faces of each lowest corner: triangles, whose keys begin with -1,
// then quadrangles. Few faces of high numbers are sorted directly, and those of invalid ones.
std::vector<FaceRef> all_faces(const Mesh& mesh) {
  size_t count = 0, nodes = 0;
  bool valid = true;
  for_each_face_of_cells(mesh, [&](const FaceRef& face) {
    ++count;
    valid = valid && face.key[1] >= 0;
    nodes = std::max(nodes, static_cast<size_t>(face.key[3]) + 1);
  });
  std::vector<FaceRef> faces;
  if (!valid || nodes > count) {
    faces.reserve(count);
    for_each_face_of_cells(mesh, [&](const FaceRef& face) { faces.push_back(face); });
    std::sort(faces.begin(), faces.end(), before);
    return faces;
  }
  const auto lowest = [&](const FaceRef& face) {
    return face.key[0] < 0 ? static_cast<size_t>(face.key[1])
                           : nodes + static_cast<size_t>(face.key[0]);
  };
  std::vector<int64_t> end(2 * nodes + 1, 0);
  for_each_face_of_cells(mesh, [&](const FaceRef& face) { ++end[lowest(face) + 1]; });
  for (size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  faces.resize(count);
  for_each_face_of_cells(mesh, [&](const FaceRef& face) { faces[end[lowest(face)]++] = face; });
  int64_t begin = 0;
  for (size_t i = 0; i + 1 < end.size(); begin = end[i], ++i)
    std::sort(faces.begin() + begin, faces.begin() + end[i], before);
  return faces;
}

}  // namespace clatter::mesh
