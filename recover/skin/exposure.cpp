// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/exposure.hpp"

#include <cmath>

#include "core/base/threads.hpp"
#include "recover/skin/ray_tree.hpp"

namespace clatter::recover {
namespace {

/// For the rays, a curved face is four flat triangles.
constexpr int kQuarters[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};

RayTree tree_of(const rom::Skin& skin) {
  std::vector<Triangle> flat;
  flat.reserve(4 * skin.triangles.rows());
  for (Eigen::Index face = 0; face < skin.triangles.rows(); ++face)
    for (const auto& quarter : kQuarters) {
      Triangle corners;
      for (int c = 0; c < 3; ++c)
        corners.col(c) = skin.nodes.row(skin.triangles(face, quarter[c])).transpose();
      flat.push_back(corners);
    }
  return RayTree(std::move(flat));
}

bool share_a_node(const IndexMatrix& triangles, Eigen::Index one, Eigen::Index other) {
  for (int a = 0; a < 6; ++a)
    if ((triangles.row(other).array() == triangles(one, a)).any()) return true;
  return false;
}

}  // namespace

Exposure exposure_of(const rom::Skin& skin, const SkinGeometry& geometry) {
  const RayTree tree = tree_of(skin);
  const auto count = static_cast<size_t>(skin.triangles.rows());
  std::vector<bool> is_sheet(count, false);
  for (const int32_t face : skin.sheet) is_sheet[face] = true;
  /// Whether what lies on a face is on that side of it; of two sheets the second one is hidden.
  const auto covers = [&](Eigen::Index other, Eigen::Index face, const Eigen::Vector3d& direction) {
    if (is_sheet[other]) return !is_sheet[face] || other < face;
    return geometry.face_normal.row(other).dot(direction) < 0.0;
  };
  const auto is_free = [&](Eigen::Index face, const Eigen::Vector3d& direction) {
    const double size = std::sqrt(geometry.face_area[face]);
    // The face itself and those beside it are flat here, which deviates by a part of their size.
    const double beside = 0.2 * size, touching = 1e-3 * size;
    return !tree.hits(geometry.face_centre.row(face), direction, -touching,
                      [&](int32_t quarter, double distance) {
                        const Eigen::Index other = quarter / 4;
                        if (distance > beside) return true;
                        if (share_a_node(skin.triangles, face, other)) return false;
                        return distance > touching || covers(other, face, direction);
                      });
  };
  std::vector<char> front(count, 0), back;
  parallel_pieces(skin.triangles.rows(), [&](int64_t begin, int64_t end) {
    for (int64_t face = begin; face < end; ++face)
      front[face] = is_free(face, geometry.face_normal.row(face)) ? 1 : 0;
  });
  if (!skin.sheet.empty()) back.assign(count, 0);
  parallel_pieces(static_cast<int64_t>(skin.sheet.size()), [&](int64_t begin, int64_t end) {
    for (int64_t at = begin; at < end; ++at) {
      const int32_t face = skin.sheet[at];
      back[face] = is_free(face, -geometry.face_normal.row(face)) ? 1 : 0;
    }
  });
  return {{front.begin(), front.end()}, {back.begin(), back.end()}};
}

}  // namespace clatter::recover
