// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Edges of sheet.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// A side of a shell, from one of its corners to the next.
struct ShellSide {
  size_t block = 0;
  Eigen::Index cell = 0, from = 0;
  int32_t a = 0, b = 0;  // its corners
};

/// The sides that one shell alone has, by their corners.
std::vector<ShellSide> free_edges(const std::vector<ShellBlock>& shells);

}  // namespace clatter::mesh
