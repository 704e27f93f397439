// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The elastic cells of a model, for stress recovery. In the file:
//   regions, cells/<b>/nodes with attributes type and region, node_ids, materials/<r> (attributes
//   rho, E and nu or dataset elasticity, expansion, conductivity, axes/, attributes hex8 ... of
//   integration), shells/<b> likewise, sections/<r> (attributes thickness, offset, bending, shear,
//   area_mass; axes/, layers/<k>, bending_material and the like, each as materials/<r>, with
//   attributes thickness and angle of layers).
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/fe/material.hpp"
#include "core/fe/shell_section.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::fe {

/// Cells on the nodes of the model. No blocks: the model has no cells.
struct FeCells {
  std::vector<std::string> regions;     // names
  std::vector<Material> materials;      // one per region; of layers the first one's
  std::vector<mesh::CellBlock> blocks;  // cells by type and region
  std::vector<mesh::ShellBlock> shells;
  std::vector<ShellSection> sections;  // one per region; of those with shells
  std::vector<int32_t> node_ids;       // node numbers of an imported mesh; empty: index + 1

  /// User-visible node number.
  int32_t label(int32_t node) const { return node_ids.empty() ? node + 1 : node_ids[node]; }
};

void write_cells(H5File& file, const FeCells& cells);

/// Cells on `nodes` (n x 3 [m]); empty when the file has none. InputError for node numbers, regions
/// and constants out of range.
FeCells read_cells(const H5File& file, const RowMatrix& nodes);

}  // namespace clatter::fe
