// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/cell_faces.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace clatter::mesh {

namespace {

bool before(const FaceRef& a, const FaceRef& b) { return a.key < b.key; }

// In linear time up to the few faces of each lowest corner: triangles, whose keys begin with -1,
// then quadrangles. Few faces of high numbers are sorted directly.
void sort_by_key(std::vector<FaceRef>& faces) {
  constexpr size_t kUnordered = std::numeric_limits<size_t>::max();  // numbers below 0
  size_t nodes = 0;
  for (const FaceRef& face : faces)
    nodes = std::max(nodes, face.key[1] < 0 ? kUnordered : static_cast<size_t>(face.key[3]) + 1);
  if (nodes > faces.size()) {
    std::sort(faces.begin(), faces.end(), before);
    return;
  }
  const auto lowest = [&](const FaceRef& face) {
    return face.key[0] < 0 ? static_cast<size_t>(face.key[1])
                           : nodes + static_cast<size_t>(face.key[0]);
  };
  std::vector<int64_t> end(2 * nodes + 1, 0);
  for (const FaceRef& face : faces) ++end[lowest(face) + 1];
  for (size_t i = 1; i < end.size(); ++i) end[i] += end[i - 1];
  std::vector<FaceRef> sorted(faces.size());
  for (const FaceRef& face : faces) sorted[end[lowest(face)]++] = face;
  int64_t begin = 0;
  for (size_t i = 0; i + 1 < end.size(); begin = end[i], ++i)
    std::sort(sorted.begin() + begin, sorted.begin() + end[i], before);
  faces = std::move(sorted);
}

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

std::vector<FaceRef> all_faces(const Mesh& mesh) {
  std::vector<FaceRef> faces;
  int64_t count = 0;
  for (const CellBlock& block : mesh.cells)
    count += block.nodes.rows() * static_cast<int64_t>(traits(block.type).faces.size());
  faces.reserve(count);
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const auto n_faces = static_cast<int32_t>(traits(mesh.cells[b].type).faces.size());
    for (Eigen::Index c = 0; c < mesh.cells[b].nodes.rows(); ++c)
      for (int32_t f = 0; f < n_faces; ++f) {
        const CellFace& local = traits(mesh.cells[b].type).faces[f];
        std::array<int32_t, 4> corners{};
        for (size_t i = 0; i < static_cast<size_t>(traits(local.type).corners); ++i)
          corners[i] = mesh.cells[b].nodes(c, local.nodes[i]);
        faces.push_back(
            {face_key(local.type, corners), static_cast<int32_t>(b), static_cast<int32_t>(c), f});
      }
  }
  sort_by_key(faces);
  return faces;
}

}  // namespace clatter::mesh
