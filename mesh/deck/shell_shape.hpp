// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The faces that shells of a deck are, and whether they can be shells.
#include <Eigen/Core>
#include <array>
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// A face of a shell, with values at its corners.
struct ShellFace {
  FaceType type = FaceType::kQuad4;
  std::array<int32_t, kMaxFaceNodes> nodes{};
  std::array<double, 4> values{};
};

/// Quadrilaterals with the same corner twice become triangles.
void drop_repeated_corner(ShellFace& face);

struct FlatShape {
  std::string defect;  // "has no area"; empty: none
  double warp = 0.0;   // of shape_of_shell()
};

/// Of its corners.
FlatShape shape_of(const ShellFace& face, const RowMatrix& nodes);

}  // namespace clatter::mesh::deck
