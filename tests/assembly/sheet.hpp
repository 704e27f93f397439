// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A flat sheet of quadrilaterals.
#include <cmath>
#include <string>

#include "core/mesh/boundary.hpp"

namespace clatter::assembly::testing {

/// In the plane x y from the origin, of region "sheet", with node sets for its sides and corners:
/// x0, x1, y0, y1, and tip, the middle of x1 (`ny` even).
inline mesh::Mesh sheet(double length, double width, int nx, int ny) {
  mesh::Mesh mesh;
  mesh.name = "sheet";
  mesh.regions = {"sheet"};
  mesh.nodes.resize((nx + 1) * (ny + 1), 3);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const int node = j * (nx + 1) + i;
      mesh.nodes.row(node) << length * i / nx, width * j / ny, 0.0;
      if (i == 0) mesh.node_sets["x0"].push_back(node);
      if (i == nx) mesh.node_sets["x1"].push_back(node);
      if (j == 0) mesh.node_sets["y0"].push_back(node);
      if (j == ny) mesh.node_sets["y1"].push_back(node);
      if (i == nx && 2 * j == ny) mesh.node_sets["tip"] = {node};
    }
  mesh::ShellBlock block;
  block.type = mesh::FaceType::kQuad4;
  block.nodes.resize(nx * ny, 4);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      block.nodes.row(j * nx + i) << a, a + 1, a + nx + 2, a + nx + 1;
    }
  mesh.shells = {block};
  mesh.surfaces["skin"] = mesh::skin_of({}, mesh.shells);
  return mesh;
}

/// 2 mm of a material without lateral contraction, so that it bends like a beam.
inline const std::string kSheetSteel =
    "[material.steel]\nregions = [\"sheet\"]\nE = 2e11\nnu = 0.0\nrho = 8000.0\n"
    "[[shell]]\nregions = [\"sheet\"]\nthickness = 0.002\n";

}  // namespace clatter::assembly::testing
