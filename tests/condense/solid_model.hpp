// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small solid parts, meshed and assembled in memory.
#include <array>
#include <string>

#include "assembly/model/build.hpp"
#include "block_mesh.hpp"
#include "core/base/log.hpp"

namespace clatter::test {

/// Steel with Poisson's ratio `nu` for the region "body", for recipes.
inline std::string steel_toml(double nu = 0.3) {
  return "[material.steel]\nregions = [\"body\"]\nE_gpa = 200.0\nrho = 8000.0\n"
         "expansion = 1.2e-5\nnu = " +
         std::to_string(nu) + "\n";
}

/// A bar of `size` [m] along x in n cells of two-by-three tetrahedra each (or another type), with
/// node sets x0 and x1 of its ends' nodes.
inline mesh::Mesh bar_mesh(const Eigen::Vector3d& size, const std::array<int, 3>& n,
                           mesh::CellType type = mesh::CellType::kTet10) {
  namespace fe = assembly;
  mesh::Mesh mesh = fe::testing::block_mesh(n, fe::testing::brick(size), {type, false, false});
  for (const char* side : {"x0", "x1"}) mesh.node_sets[side] = mesh::nodes_of(mesh.surface(side));
  return mesh;
}

/// The model of a mesh with a recipe in TOML.
inline fe::FeModel model_of(mesh::Mesh mesh, const std::string& toml) {
  set_quiet(true);
  const Config config = Config::parse(toml, "bar.fe.toml");
  StepClock clock;
  return assembly::build_fe_model(mesh, assembly::read_recipe(config, mesh), clock).model;
}

/// A bar of steel; `more` is fe.toml.
inline fe::FeModel solid_bar(const Eigen::Vector3d& size, const std::array<int, 3>& n, double nu,
                             const std::string& more,
                             mesh::CellType type = mesh::CellType::kTet10) {
  return model_of(bar_mesh(size, n, type), steel_toml(nu) + more);
}

}  // namespace clatter::test
