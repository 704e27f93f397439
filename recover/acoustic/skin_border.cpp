// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/skin_border.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace clatter::recover {
namespace {

using CornerPair = std::pair<int32_t, int32_t>;

/// Corners of the edges that belong to an odd number of faces of solids.
std::vector<CornerPair> border_edges(const rom::Skin& skin) {
  const IndexMatrix& triangles = skin.triangles;
  std::vector<bool> is_sheet(static_cast<size_t>(triangles.rows()), false);
  for (const int32_t face : skin.sheet) is_sheet[face] = true;
  std::map<CornerPair, int> faces;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    if (is_sheet[f]) continue;
    for (int a = 0; a < 3; ++a) ++faces[std::minmax(triangles(f, a), triangles(f, (a + 1) % 3))];
  }
  std::vector<CornerPair> border;
  for (const auto& [edge, count] : faces)
    if (count % 2 == 1) border.push_back(edge);
  return border;
}

}  // namespace

SkinBorder skin_border(const rom::Skin& skin) {
  const std::vector<CornerPair> edges = border_edges(skin);
  std::map<int32_t, int32_t> joined;  // to a node of the same border
  const auto root = [&](int32_t node) {
    while (joined.at(node) != node) node = joined.at(node);
    return node;
  };
  for (const auto& [a, b] : edges) {
    joined.try_emplace(a, a);
    joined.try_emplace(b, b);
    const auto [low, high] = std::minmax({root(a), root(b)});
    joined[high] = low;
  }
  std::map<int32_t, Eigen::AlignedBox3d> extent;
  for (const auto& [node, other] : joined)
    extent[root(node)].extend(Eigen::Vector3d(skin.nodes.row(node)));
  SkinBorder out{static_cast<int64_t>(edges.size()), 0.0};
  for (const auto& [node, box] : extent) out.widest = std::max(out.widest, box.sizes().maxCoeff());
  return out;
}

}  // namespace clatter::recover
