#pragma once
// The elastic cells behind a model's matrices: what stresses are recovered from. In the file:
//   regions, cells/<b>/nodes with attributes type and region, node_ids, materials/<r> (attributes
//   rho, E and nu or dataset elasticity, expansion, axes/, attributes hex8 ... of integration).
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// Cells on the nodes of the model. Without blocks: nothing is known of them.
struct FeCells {
  std::vector<std::string> regions;     // names
  std::vector<Material> materials;      // one a region
  std::vector<mesh::CellBlock> blocks;  // cells by type and region
  std::vector<int32_t> node_ids;        // what an imported mesh calls its nodes; empty: index + 1

  /// The number by which users know a node.
  int32_t label(int32_t node) const {
    return node_ids.empty() ? node + 1 : node_ids[static_cast<size_t>(node)];
  }
};

void write_cells(H5File& file, const FeCells& cells);

/// Cells on `nodes` (n x 3 [m]); none when the file has none. InputError for node numbers, regions
/// and constants out of range.
FeCells read_cells(const H5File& file, const RowMatrix& nodes);

}  // namespace clatter::fe
