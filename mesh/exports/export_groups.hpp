// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Groups for export formats with face elements: each face and node once, with the groups that
// contain it, and the external numbers of nodes and cells.
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A face that belongs to one or more surfaces.
struct ExportFace {
  FaceType type = FaceType::kTri6;
  std::vector<int32_t> nodes;    // rows, order of cell.hpp, as in the first surface
  std::vector<size_t> surfaces;  // indices in the order of Mesh::surfaces, ascending
};

/// All faces of all surfaces, by type, in order of appearance. A face that two surfaces have from
/// either side (between two regions) appears once.
std::vector<ExportFace> export_faces(const Mesh& mesh);

/// Node sets that contain each node: indices in the order of Mesh::node_sets, ascending.
std::vector<std::vector<size_t>> sets_of_nodes(const Mesh& mesh);

/// Numbers of the nodes and, block by block, of the cells: those of the imported file if they are
/// positive and unique, else counted from 1.
std::vector<int32_t> export_node_numbers(const Mesh& mesh);
std::vector<std::vector<int32_t>> export_cell_numbers(const Mesh& mesh);

}  // namespace clatter::mesh
