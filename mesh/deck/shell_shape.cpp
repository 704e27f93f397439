// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/shell_shape.hpp"

#include <algorithm>

#include "core/mesh/shell_shape.hpp"

namespace clatter::mesh::deck {
namespace {

// Area over that of a square on the longest side, and of a corner over the cell's: below them no
// digit of the normal is left.
constexpr double kLeastArea = 1e-8, kLeastCorner = 1e-6;

// Of the two nodes of a side.
double mean(double a, double b) { return 0.5 * (a + b); }

ShellFace part_of(const ShellFace& face, std::initializer_list<int32_t> nodes,
                  std::initializer_list<double> values) {
  ShellFace part;
  part.type = nodes.size() == 3 ? FaceType::kTri3 : FaceType::kQuad4;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const int32_t at = nodes.begin()[i];
    part.nodes[i] = at < 0 ? face.centre : face.nodes[static_cast<size_t>(at)];
    part.values[i] = values.begin()[i];
  }
  return part;
}

std::vector<ShellFace> parts_of_tri6(const ShellFace& f) {
  const auto [a, b, c, unused] = f.values;
  const double ab = mean(a, b), bc = mean(b, c), ca = mean(c, a);
  return {part_of(f, {0, 3, 5}, {a, ab, ca}), part_of(f, {3, 1, 4}, {ab, b, bc}),
          part_of(f, {5, 4, 2}, {ca, bc, c}), part_of(f, {3, 4, 5}, {ab, bc, ca})};
}

std::vector<ShellFace> parts_of_quad8(const ShellFace& f) {
  const auto [a, b, c, d] = f.values;
  const double ab = mean(a, b), bc = mean(b, c), cd = mean(c, d), da = mean(d, a);
  const double all = mean(ab, cd);
  return {part_of(f, {0, 4, -1, 7}, {a, ab, all, da}), part_of(f, {4, 1, 5, -1}, {ab, b, bc, all}),
          part_of(f, {-1, 5, 2, 6}, {all, bc, c, cd}), part_of(f, {7, -1, 6, 3}, {da, all, cd, d})};
}

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

bool has_centre(const ShellFace& face) {
  ShellFace kept = face;
  drop_repeated_corner(kept);
  return kept.type == FaceType::kQuad8;
}

Eigen::Vector3d shell_centre(std::span<const Eigen::Vector3d, 8> nodes) {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (size_t i = 0; i < 8; ++i) at += (i < 4 ? -0.25 : 0.5) * nodes[i];
  return at;
}

std::vector<ShellFace> linear_parts(const ShellFace& face) {
  if (face.type == FaceType::kTri6) return parts_of_tri6(face);
  if (face.type == FaceType::kQuad8) return parts_of_quad8(face);
  return {face};
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
