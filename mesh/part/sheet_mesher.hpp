// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes a sheet with shells.
#include <string>

#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

/// Quadrilaterals by Gmsh's recombination; those too warped or skewed for a shell become two
/// triangles. All have one outward side, and the sheet's thickness and offset. Surfaces and edges
/// are named; the node set free_edges has the nodes of edges of one shell. Errors as of
/// mesh_part().
PartMesh mesh_sheet(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                    double metres_per_unit, const std::string& name, const std::string& where);

}  // namespace clatter::mesh
