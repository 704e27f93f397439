// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Elements of ANSYS archives.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/mesh/cell.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh {

/// A cell and its nodes in Gmsh's order.
struct CdbCell {
  CellType type;
  std::vector<size_t> nodes;
};

/// The cell of a SOLID45, 92, 95, 185, 186 or 187 with these nodes, of which some may be the same
/// (cell_repair.hpp). None for another count, and for an omitted mid-side node.
std::optional<CdbCell> cdb_cell(int routine, const std::vector<size_t>& nodes);

/// True for the routines above.
bool is_cdb_solid(int routine);

/// KEYOPT(2) of SOLID185 (0 full, 1 reduced, 2 and 3 enhanced strain) and SOLID186 (0 reduced, 1
/// full), for hexahedra; SOLID45 has incompatible modes.
deck::Formulation cdb_formulation(int routine, int keyopt2, CellType type);

}  // namespace clatter::mesh
