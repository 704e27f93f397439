// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A small part for the tests of statics.
#include <string>

#include "block_mesh.hpp"
#include "small_solver.hpp"

namespace clatter::modal::testing {

/// A bar of 0.1 x 0.2 x 0.4 m with the supports, loads and cases of `toml`; node set "corner" is
/// its node at the origin.
inline fe::FeModel bar(const std::string& toml) {
  mesh::Mesh mesh =
      assembly::testing::block_mesh({2, 2, 4}, assembly::testing::brick({0.1, 0.2, 0.4}));
  mesh.node_sets["corner"] = {0};
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    if (mesh.nodes.row(a).norm() < 1e-12) mesh.node_sets["corner"][0] = static_cast<int32_t>(a);
  return assembly::testing::build(mesh, toml).model;
}

/// Three faces slide in their planes: the bar stretches freely.
constexpr const char* kSlide =
    "[[support]]\nname = \"floor\"\nsurface = \"z0\"\ndirections = \"z\"\n"
    "[[support]]\nname = \"wall_x\"\nsurface = \"x0\"\ndirections = \"x\"\n"
    "[[support]]\nname = \"wall_y\"\nsurface = \"y0\"\ndirections = \"y\"\n";

}  // namespace clatter::modal::testing
