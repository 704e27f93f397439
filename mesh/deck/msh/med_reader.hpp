// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// MED files (Salome, Code_Aster): HDF5 in the layout of MED 3 and 4.
//
// Groups of solids are regions, of faces surfaces, of edges, points and nodes node sets. Source:
// MED file format, model of data 3.0 (EDF, CEA).
#include <filesystem>

#include "mesh/deck/msh/foreign_mesh.hpp"

namespace clatter::mesh {

/// InputError for a file with several meshes, and for elements that are no solids, faces or edges
/// unless `ignore` has their type in MED's name ("HE27").
ForeignMesh read_med(const std::filesystem::path& path, const std::vector<std::string>& ignore);

}  // namespace clatter::mesh
