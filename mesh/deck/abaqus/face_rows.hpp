// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Faces of numbered cells.
#include <array>
#include <cstdint>
#include <utility>

#include "core/mesh/cell.hpp"
#include "mesh/deck/abaqus/numbering.hpp"

namespace clatter::mesh::deck::abaqus {

/// A cell and the number of its face among those of its traits.
using CellFaceId = std::pair<int32_t, int32_t>;

/// Rows of a face of a cell, in our order: `count` entries.
struct FaceRows {
  std::array<int32_t, kMaxFaceNodes> rows;
  size_t count, corners;
  auto begin() const { return rows.begin(); }
  auto end() const { return rows.begin() + static_cast<long>(count); }
};
FaceRows face_rows(const Numbering& numbering, CellFaceId id);

/// How many faces a cell has.
int32_t face_count(const Numbering& numbering, int32_t cell);

/// The corners, ascending, -1 first for a triangle: the same for both cells that share a face.
using FaceCorners = std::array<int32_t, 4>;
FaceCorners sorted_corners(const FaceRows& face);

}  // namespace clatter::mesh::deck::abaqus
