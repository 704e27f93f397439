// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mesh for Salome, Code_Aster, Code_Saturne: a MED file.
#include <filesystem>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A MED 3 file in its HDF5 layout (Debian's libmed needs the parallel HDF5 library, which cannot
/// be linked with the serial one), lengths in metres. Regions and surfaces are groups of cells,
/// node sets groups of nodes; nodes and cells keep their numbers. A face of several surfaces is
/// written once, in a family of all their groups, a shell in those of its region and its surfaces.
///
/// MED's solids have the opposite orientation to ours (core/mesh/cell.hpp), faces have our order.
/// InputError for names over 80 bytes (the mesh name is cut at 64).
void write_med(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace clatter::mesh
