// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Groups for export formats with face elements: each face and node once, with the groups that
// contain it, and the external numbers of nodes and cells.
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A shell, or a face that belongs to one or more surfaces.
struct ExportFace {
  FaceType type = FaceType::kTri6;
  std::vector<int32_t> nodes;    // rows, order of cell.hpp, as of the shell or in the first surface
  std::vector<size_t> surfaces;  // indices in the order of Mesh::surfaces, ascending
  int32_t region = -1;           // of a shell, index into Mesh::regions
  int32_t number = 0;            // of a shell
};

/// All shells, and all faces of all surfaces, by type, in order of appearance. A face that two
/// surfaces have from either side (between two regions, of a shell) appears once.
std::vector<ExportFace> export_faces(const Mesh& mesh);

/// Names of the regions; one of shells whose name a surface has too is followed by "_shells",
/// because both are groups of faces.
std::vector<std::string> export_region_names(const Mesh& mesh);

/// Node sets that contain each node: indices in the order of Mesh::node_sets, ascending.
std::vector<std::vector<size_t>> sets_of_nodes(const Mesh& mesh);

/// Numbers of the nodes and, block by block, of the solids: those of the imported file if they are
/// positive and unique, else counted from 1. Those of the shells are deck::shell_numbers().
std::vector<int32_t> export_node_numbers(const Mesh& mesh);
std::vector<std::vector<int32_t>> export_cell_numbers(const Mesh& mesh);

/// The largest number of solids and shells.
int32_t largest_cell_number(const std::vector<std::vector<int32_t>>& solids,
                            const std::vector<ExportFace>& faces);

}  // namespace clatter::mesh
