#pragma once
// The mesh for Salome, Code_Aster, Code_Saturne: a MED file.
#include <filesystem>

#include "mesh/mesh.hpp"

namespace clatter::mesh {

/// A MED 3 file in its HDF5 layout (Debian's libmed needs the parallel HDF5 library, which does not
/// go into one program with the serial one), lengths in metres. Regions and surfaces are groups of
/// cells, node sets groups of nodes; nodes and cells keep their numbers. A face that several
/// surfaces have is there once, in a family of all their groups.
///
/// MED's solids are turned over against ours: its corners are ours 0 2 1 3 (tetrahedron), 0 3 2 1 4
/// 7 6 5 (brick), 0 2 1 3 5 4 (wedge), 0 3 2 1 4 (pyramid), then the middles of the edges of the
/// lower face in turn, of the upper one, of those between them. Faces have our order. InputError
/// for names over 80 bytes (of the mesh: 64 are kept).
void write_med(const Mesh& mesh, const std::filesystem::path& path);

/// p with a_med[i] = a_ours[p[i]].
std::vector<int> to_med(CellType type);

}  // namespace clatter::mesh
