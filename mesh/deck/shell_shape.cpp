// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/shell_shape.hpp"

#include <algorithm>

#include "core/mesh/shell_shape.hpp"

namespace clatter::mesh::deck {
namespace {

// Area over that of a square on the longest side, and of a corner over the cell's: below them no
// digit of the normal is left.
constexpr double kLeastArea = 1e-8, kLeastCorner = 1e-6;

}  // namespace

void drop_repeated_corner(ShellFace& face) {
  if (traits(face.type).corners != 4) return;
  const bool quadratic = traits(face.type).order == 2;
  for (size_t i = 0; i < 4; ++i) {
    const size_t j = (i + 1) % 4;
    if (face.nodes[i] != face.nodes[j]) continue;
    ShellFace kept;
    kept.type = quadratic ? FaceType::kTri6 : FaceType::kTri3;
    for (size_t k = 0, to = 0; k < 4; ++k) {
      if (k == std::max(i, j)) continue;
      kept.values[to] = face.values[k];
      kept.nodes[to++] = face.nodes[k];
    }
    for (size_t k = 0, to = 3; quadratic && k < 4; ++k)
      if (k != i) kept.nodes[to++] = face.nodes[4 + k];
    face = kept;
    return;
  }
}

FlatShape shape_of(const ShellFace& face, const RowMatrix& nodes) {
  const auto n = static_cast<size_t>(traits(face.type).corners);
  std::array<Eigen::Vector3d, 4> x;
  for (size_t i = 0; i < n; ++i) x[i] = nodes.row(face.nodes[i]);
  const ShellShape shape = shape_of_shell(std::span(x).first(n));
  if (!(shape.area > kLeastArea)) return {"has no area, expected a face", 0.0};
  if (n == 4 && shape.corner < kLeastCorner)
    return {"is concave or folded, expected four corners that go around", 0.0};
  return {"", shape.warp};
}

}  // namespace clatter::mesh::deck
