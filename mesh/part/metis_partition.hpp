// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Partition of a mesh by METIS (Karypis and Kumar, SIAM J. Sci. Comput. 20, 1998).
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Which part each cell belongs to, cells numbered through all blocks.
struct Partition {
  int parts = 1;
  std::vector<int32_t> part;  // 0 ... parts - 1
  int64_t cut = 0;            // faces between cells of different parts
};

/// Cells that share a face with each cell, in compressed rows.
struct CellNeighbours {
  std::vector<int64_t> start;      // cells + 1
  std::vector<int32_t> neighbour;  // ascending in each row

  /// Bodies: sets of cells that faces connect; their number for each cell.
  std::vector<int32_t> bodies() const;
};

/// Neighbours across faces, found by corners alone: cells that share only an edge are not
/// neighbours, whatever mid-side nodes lie on it (hard case M1).
CellNeighbours cell_neighbours(const Mesh& mesh);

/// Divides the cells into `parts` connected parts of nearly equal size with few faces between them;
/// the same result on every run. METIS may crash or end the process on some graphs, so it runs in a
/// child process (hard case M4). InputError unless 1 <= parts <= cells and the mesh is one body;
/// NumericsError when METIS fails, or leaves a part empty or disconnected.
Partition partition_cells(const Mesh& mesh, int parts);

/// Runs METIS on a graph of cells, in a child process: the part of each cell. NumericsError when it
/// reports an error or crashes.
std::vector<int32_t> metis_parts(const CellNeighbours& graph, int parts);

}  // namespace clatter::mesh
