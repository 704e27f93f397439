// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The cut through the shank of a bolt, along faces between its cells.
#include <cstdint>
#include <vector>

#include "mesh/deck/abaqus/face_rows.hpp"

namespace clatter::mesh::deck::abaqus {

/// A cut: each of its faces as that of the cell on the near side and of the one on the far side.
struct BoltCut {
  Origin origin = 0;  // of its card
  size_t use = 0;
  std::vector<CellFaceId> near, far;  // the same order
  std::vector<int32_t> rows;          // of its nodes, ascending
  std::vector<int32_t> cells;         // on the near side with such nodes, ascending
};

/// Cuts along `near`, faces inside the model. InputError at `origin` for a face without a cell on
/// its other side, and where the two sides are connected beside the cut.
BoltCut cut_along(const Numbering& numbering, std::vector<CellFaceId> near, size_t use,
                  Origin origin);

}  // namespace clatter::mesh::deck::abaqus
