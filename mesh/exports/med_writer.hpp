#pragma once
// The mesh for Salome, Code_Aster, Code_Saturne: a MED file.
#include <filesystem>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A MED 3 file in its HDF5 layout (Debian's libmed needs the parallel HDF5 library, which does not
/// go into one program with the serial one), lengths in metres. Regions and surfaces are groups of
/// cells, node sets groups of nodes; nodes and cells keep their numbers. A face that several
/// surfaces have is there once, in a family of all their groups.
///
/// MED's solids are turned over against ours (core/mesh/cell.hpp), faces have our order. InputError
/// for names over 80 bytes (of the mesh: 64 are kept).
void write_med(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace clatter::mesh
