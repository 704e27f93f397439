// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes of part.mesh.toml texts.
#include <string>

#include "core/mesh/boundary.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/part/part_file.hpp"

namespace clatter::mesh::testing {

struct Meshed {
  PartMesh part;
  double volume(const std::string& region) const {
    for (size_t r = 0; r < part.mesh.regions.size(); ++r) {
      if (part.mesh.regions[r] == region) return cell_volume(part.mesh, static_cast<int32_t>(r));
    }
    return 0.0;
  }
};

inline Meshed mesh_toml(const std::string& text) {
  const PartFile file = part_keys().read(Config::parse(text, "part.toml"));
  GmshSession session(file.name);
  const PartGeometry part = build_part(session, file.shape);
  return {mesh_part(session, part, file.mesh, file.shape.unit.metres, file.name, "part.toml")};
}

}  // namespace clatter::mesh::testing
