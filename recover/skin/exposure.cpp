// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "core/base/threads.hpp"
#include "recover/skin/panels.hpp"
#include "recover/skin/ray_tree.hpp"

namespace clatter::recover {

std::vector<bool> exposed_faces(const RowMatrix& nodes, const IndexMatrix& triangles,
                                const SkinGeometry& geometry) {
  // For the rays, a curved face is four flat triangles.
  static constexpr int kQuarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
  std::vector<Triangle> flat;
  flat.reserve(4 * triangles.rows());
  for (Eigen::Index face = 0; face < triangles.rows(); ++face)
    for (const auto& quarter : kQuarters) {
      Triangle corners;
      for (int c = 0; c < 3; ++c)
        corners.col(c) = nodes.row(triangles(face, quarter[c])).transpose();
      flat.push_back(corners);
    }
  const RayTree tree(std::move(flat));

  std::vector<char> exposed(static_cast<size_t>(triangles.rows()), 0);
  parallel_pieces(triangles.rows(), [&](int64_t begin, int64_t end) {
    for (int64_t face = begin; face < end; ++face) {
      // The ray must not hit the face itself, whose flat approximation deviates by a part of its
      // size.
      const double clearance = 0.2 * std::sqrt(geometry.face_area[face]);
      exposed[face] =
          !tree.hits(geometry.face_centre.row(face), geometry.face_normal.row(face), clearance);
    }
  });
  return {exposed.begin(), exposed.end()};
}

}  // namespace clatter::recover
