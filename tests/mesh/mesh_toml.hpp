// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes of part.mesh.toml texts.
#include <string>

#include "core/base/config.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/geometry/part_geometry.hpp"
#include "mesh/part/mesher.hpp"

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
  const Config config = Config::parse(text, "part.toml");
  GmshSession session(config.text("name"));
  const LengthUnit unit = read_length_unit(config);
  const MeshSettings settings = read_mesh_settings(config);
  const PartGeometry part = build_part(session, config);
  config.finish();
  return {mesh_part(session, part, settings, unit.metres, config.text("name"), "part.toml")};
}

}  // namespace clatter::mesh::testing
