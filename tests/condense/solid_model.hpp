// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small solid parts, meshed and assembled in memory.
#include <array>
#include <string>

#include "assembly/model/build.hpp"
#include "block_mesh.hpp"
#include "core/base/log.hpp"

namespace clatter::test {

/// A bar of `size` [m] along x in n cells of two-by-three tetrahedra each (or another type), with
/// node sets x0 and x1 of its ends' nodes. Steel with Poisson's ratio `nu`; `more` is fe.toml.
inline fe::FeModel solid_bar(const Eigen::Vector3d& size, const std::array<int, 3>& n, double nu,
                             const std::string& more,
                             mesh::CellType type = mesh::CellType::kTet10) {
  namespace fe = assembly;
  set_quiet(true);
  mesh::Mesh mesh = fe::testing::block_mesh(n, fe::testing::brick(size), {type, false, false});
  for (const char* side : {"x0", "x1"}) mesh.node_sets[side] = mesh::nodes_of(mesh.surface(side));
  const std::string steel =
      "[material.steel]\nregions = [\"body\"]\nE_gpa = 200.0\nrho = 8000.0\n"
      "expansion = 1.2e-5\nnu = " +
      std::to_string(nu) + "\n";
  const Config config = Config::parse(steel + more, "bar.fe.toml");
  StepClock clock;
  return fe::build_fe_model(mesh, fe::read_recipe(config, mesh), clock).model;
}

}  // namespace clatter::test
