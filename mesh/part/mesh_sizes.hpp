// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From the names and sizes of a mesh.toml to faces and sizes of Gmsh.
#include <map>
#include <string>
#include <vector>

#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

using FaceTags = std::map<std::string, std::vector<int>>;

/// The faces of each surface; InputError for one that has none.
FaceTags find_surfaces(const std::vector<FaceFacts>& faces,
                       const std::vector<NamedSurface>& surfaces, const std::string& unit,
                       const std::string& where);

/// Sizes in the part's unit, at most kCoarsest of it; says which features are far smaller.
/// InputError for local sizes on no surface.
SizeSettings size_settings(GmshSession& session, const MeshSettings& settings,
                           const std::vector<FaceFacts>& faces, const FaceTags& surfaces,
                           double metres_per_unit, const std::string& where);

}  // namespace clatter::mesh
