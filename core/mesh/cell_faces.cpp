// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/cell_faces.hpp"

#include <algorithm>

namespace clatter::mesh {

BoundaryFace face_at(const Mesh& mesh, const FaceRef& ref) {
  const CellBlock& block = mesh.cells[static_cast<size_t>(ref.block)];
  const CellFace& local = traits(block.type).faces[static_cast<size_t>(ref.face)];
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
  faces.reserve(static_cast<size_t>(count));
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const auto n_faces = static_cast<int32_t>(traits(mesh.cells[b].type).faces.size());
    for (Eigen::Index c = 0; c < mesh.cells[b].nodes.rows(); ++c)
      for (int32_t f = 0; f < n_faces; ++f) {
        FaceRef ref{{}, static_cast<int32_t>(b), static_cast<int32_t>(c), f};
        const BoundaryFace face = face_at(mesh, ref);
        ref.key = face_key(face.type, face.nodes());
        faces.push_back(ref);
      }
  }
  std::sort(faces.begin(), faces.end(),
            [](const FaceRef& a, const FaceRef& b) { return a.key < b.key; });
  return faces;
}

}  // namespace clatter::mesh
