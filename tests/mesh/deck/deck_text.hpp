// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Decks of block meshes as text, written without the program's own writers and tables.
#include <fmt/format.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::test {

/// Corners at the ends of a cell's edges, in the order of Nastran's mid-side nodes; Abaqus has the
/// same for tetrahedra.
inline std::vector<std::array<int, 2>> edges_of_decks(int corners) {
  if (corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  if (corners == 5) return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5},
          {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
}

/// Rows of the nodes of each cell of the first block, as decks list them: the corners, then the
/// node in the middle of each edge, found by its position.
inline std::vector<std::vector<int32_t>> listed_cells(const mesh::Mesh& mesh) {
  std::map<std::array<double, 3>, int32_t> row_at;
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    row_at[{mesh.nodes(a, 0), mesh.nodes(a, 1), mesh.nodes(a, 2)}] = static_cast<int32_t>(a);
  const mesh::CellBlock& block = mesh.cells.at(0);
  const mesh::CellTraits& traits = mesh::traits(block.type);
  std::vector<std::vector<int32_t>> cells;
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
    std::vector<int32_t>& cell = cells.emplace_back();
    for (int i = 0; i < traits.corners; ++i) cell.push_back(block.nodes(c, i));
    if (traits.order == 1) continue;
    for (const auto& [i, j] : edges_of_decks(traits.corners)) {
      const Eigen::RowVector3d at =
          0.5 * (mesh.nodes.row(block.nodes(c, i)) + mesh.nodes.row(block.nodes(c, j)));
      cell.push_back(row_at.at({at(0), at(1), at(2)}));
    }
  }
  return cells;
}

/// A clamped C3D4 or C3D10 beam for Abaqus: a part, its instance, the node set "fixed" of side z0,
/// the element set "solid"; N, mm, t. `elements` come after those of the part.
inline std::string abaqus_beam(const mesh::Mesh& mesh, const std::string& elements = "") {
  std::string text = "*HEADING\n*PART, NAME=Beam\n*NODE\n", fixed;
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a) {
    text += fmt::format("{}, {:.17g}, {:.17g}, {:.17g}\n", a + 1, mesh.nodes(a, 0),
                        mesh.nodes(a, 1), mesh.nodes(a, 2));
    if (mesh.nodes(a, 2) == 0.0) fixed += fmt::format("{},\n", a + 1);
  }
  const auto cells = listed_cells(mesh);
  text += fmt::format("*ELEMENT, TYPE=C3D{}, ELSET=solid\n", cells.at(0).size());
  for (size_t c = 0; c < cells.size(); ++c) {
    text += fmt::format("{}", c + 1);
    for (const int32_t row : cells[c]) text += fmt::format(", {}", row + 1);
    text += "\n";
  }
  return text + elements +
         "*SOLID SECTION, ELSET=solid, MATERIAL=steel\n*END PART\n*ASSEMBLY, NAME=Whole\n"
         "*INSTANCE, NAME=Beam-1, PART=Beam\n*END INSTANCE\n*NSET, NSET=fixed, INSTANCE=Beam-1\n" +
         fixed +
         "*END ASSEMBLY\n*MATERIAL, NAME=steel\n*DENSITY\n7.85e-9,\n*ELASTIC\n208000., 0.3\n"
         "*STEP\n*FREQUENCY\n10,\n*BOUNDARY\nfixed, 1, 3\n*END STEP\n";
}

}  // namespace clatter::test
