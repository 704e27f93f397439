// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Elements of I-DEAS universal files: descriptors and node orders of dataset 2412.
#include <optional>
#include <span>

#include "core/mesh/cell.hpp"

namespace clatter::mesh::deck {

struct UnvKind {
  int descriptor;              // 0: the format has no such element
  std::span<const int> nodes;  // p with a_unv[i] = a_ours[p[i]]
};

UnvKind unv_kind(CellType type);
/// As a thin shell.
UnvKind unv_kind(FaceType type);

/// The inverse for solids.
std::optional<CellType> unv_cell(int descriptor);
/// The same for shells, membranes, plane stress and plane strain elements.
std::optional<FaceType> unv_face(int descriptor);
/// Nodes of rods and beams, which have a line more; 0 for other elements.
int unv_line_nodes(int descriptor);

}  // namespace clatter::mesh::deck
