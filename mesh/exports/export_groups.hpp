#pragma once
// What exports with families and elements of faces need: each face and node once, with the groups
// that it is in, and the numbers that other programs call nodes and cells by.
#include <map>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A face of surfaces, once, however many have it.
struct ExportFace {
  FaceType type = FaceType::kTri6;
  std::vector<int32_t> nodes;    // rows, order of cell.hpp, as the first surface has it
  std::vector<size_t> surfaces;  // indices in the order of Mesh::surfaces, ascending
};

/// All faces of all surfaces, by type, in order of appearance. Surfaces that have the same face
/// from either side (between two regions) have it once.
std::vector<ExportFace> export_faces(const Mesh& mesh);

/// Node sets that each node is in: indices in the order of Mesh::node_sets, ascending.
std::vector<std::vector<size_t>> sets_of_nodes(const Mesh& mesh);

/// Numbers of the nodes and, block by block, of the cells: those of the imported file, else (also
/// where they are not positive and different) counted from 1.
std::vector<int32_t> export_node_numbers(const Mesh& mesh);
std::vector<std::vector<int32_t>> export_cell_numbers(const Mesh& mesh);

}  // namespace clatter::mesh
