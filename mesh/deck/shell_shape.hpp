// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The faces that shells of a deck are: parts of quadratic ones, and whether they can be shells.
#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// A face of a shell, with values at its corners.
struct ShellFace {
  FaceType type = FaceType::kQuad4;
  std::array<int32_t, kMaxFaceNodes> nodes{};
  std::array<double, 4> values{};
  int32_t centre = -1;  // of a quad8, at shell_centre()
};

/// Quadrilaterals with the same corner twice become triangles.
void drop_repeated_corner(ShellFace& face);

/// True for a quad8 of four different corners.
bool has_centre(const ShellFace& face);

/// By the shape functions of a quad8: -1/4 of the corners + 1/2 of the mid-side nodes.
Eigen::Vector3d shell_centre(std::span<const Eigen::Vector3d, 8> nodes);

/// A linear face itself, else the four linear ones between its nodes; values are linear between the
/// corners.
std::vector<ShellFace> linear_parts(const ShellFace& face);

struct FlatShape {
  std::string defect;  // "has no area"; empty: none
  double warp = 0.0;   // of shape_of_shell()
};

/// Of a linear face.
FlatShape shape_of(const ShellFace& face, const RowMatrix& nodes);

}  // namespace clatter::mesh::deck
