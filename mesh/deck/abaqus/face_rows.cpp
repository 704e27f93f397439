// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/face_rows.hpp"

#include <algorithm>
#include <span>

namespace clatter::mesh::deck::abaqus {

FaceRows face_rows(const Numbering& numbering, CellFaceId id) {
  const CellType type = numbering.table_of(id.first).type;
  const CellFace& face = traits(type).faces[id.second];
  const std::span<const int> p = traits(type).to_abaqus;
  const auto rows = numbering.nodes_of(id.first);
  FaceRows out{{},
               static_cast<size_t>(traits(face.type).nodes),
               static_cast<size_t>(traits(face.type).corners)};
  for (size_t i = 0; i < out.count; ++i) {
    out.rows[i] = rows[std::find(p.begin(), p.end(), face.nodes[i]) - p.begin()];
  }
  return out;
}

int32_t face_count(const Numbering& numbering, int32_t cell) {
  return static_cast<int32_t>(traits(numbering.table_of(cell).type).faces.size());
}

FaceCorners sorted_corners(const FaceRows& face) {
  FaceCorners corners{-1, -1, -1, -1};
  std::copy_n(face.rows.begin(), face.corners, corners.begin());
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace clatter::mesh::deck::abaqus
