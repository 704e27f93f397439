// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A wall that conducts heat: recipe and mesh.
#include <string>

#include "block_mesh.hpp"

namespace clatter::assembly::testing {

inline const std::string kIron =
    "[material.iron]\nregions = [\"body\"]\nE = 1.1e11\nnu = 0.26\nrho = 7200.0\n"
    "expansion = 1.1e-5\nconductivity = 50.0\n";

/// Heat along z through a wall of 0.1 x 0.2 x 0.4 m.
inline const std::string kWall = R"(
[[heat]]
name = "warm"
[[heat.film]]
surface = "z0"
coefficient = 500.0
temperature_c = 20.0
[[heat.film]]
surface = "z1"
coefficient = 200.0
temperature_c = 300.0
)";

inline mesh::Mesh wall_of(mesh::CellType type) {
  BlockOptions options;
  options.type = type;
  return block_mesh({2, 2, 3}, shaken_brick({0.1, 0.2, 0.4}, {2, 2, 3}, 0.2), options);
}

}  // namespace clatter::assembly::testing
