// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/ray_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace clatter::recover {
namespace {

/// Slab test from t_min on; the reciprocal is infinite for a ray along the slab.
bool meets_box(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& reciprocal, double t_min) {
  double near = t_min, far = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d) {
    if (std::isinf(reciprocal[d])) {
      if (origin[d] < box.min()[d] || origin[d] > box.max()[d]) return false;
      continue;
    }
    const double a = (box.min()[d] - origin[d]) * reciprocal[d];
    const double b = (box.max()[d] - origin[d]) * reciprocal[d];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

/// Where the ray meets the triangle: Moeller and Trumbore (1997).
std::optional<double> meets_triangle(const Triangle& corners, const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction) {
  const Eigen::Vector3d edge_1 = corners.col(1) - corners.col(0);
  const Eigen::Vector3d edge_2 = corners.col(2) - corners.col(0);
  const Eigen::Vector3d p = direction.cross(edge_2);
  const double determinant = edge_1.dot(p);
  if (std::abs(determinant) < 1e-12 * edge_1.norm() * edge_2.norm()) return std::nullopt;
  const Eigen::Vector3d s = origin - corners.col(0);
  const double u = s.dot(p) / determinant;
  if (u < 0.0 || u > 1.0) return std::nullopt;
  const Eigen::Vector3d q = s.cross(edge_1);
  const double v = direction.dot(q) / determinant;
  if (v < 0.0 || u + v > 1.0) return std::nullopt;
  return edge_2.dot(q) / determinant;
}

}  // namespace

RayTree::RayTree(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!triangles_.empty()) build(0, static_cast<int>(triangles_.size()));
}

int RayTree::build(int first, int count) {
  constexpr int kLeaf = 8;
  const int index = static_cast<int>(boxes_.size());
  boxes_.emplace_back();
  const auto begin = order_.begin() + first, end = begin + count;
  Eigen::AlignedBox3d extent, centres;
  for (auto it = begin; it != end; ++it) {
    const Triangle& corners = triangles_[*it];
    for (int c = 0; c < 3; ++c) extent.extend(corners.col(c));
    centres.extend(corners.rowwise().mean());
  }
  boxes_[index].extent = extent;
  if (count <= kLeaf) {
    boxes_[index].first = first;
    boxes_[index].count = count;
    return index;
  }
  Eigen::Index longest;
  centres.sizes().maxCoeff(&longest);
  std::nth_element(begin, begin + count / 2, end, [&](int32_t a, int32_t b) {
    return triangles_[a].row(longest).sum() < triangles_[b].row(longest).sum();
  });
  const int left = build(first, count / 2);
  const int right = build(first + count / 2, count - count / 2);
  boxes_[index].left = left;
  boxes_[index].right = right;
  return index;
}

bool RayTree::hits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double t_min,
                   const Counts& counts) const {
  if (boxes_.empty()) return false;
  const Eigen::Vector3d reciprocal = direction.cwiseInverse();
  std::vector<int> open{0};
  while (!open.empty()) {
    const Box& box = boxes_[open.back()];
    open.pop_back();
    if (!meets_box(box.extent, origin, reciprocal, t_min)) continue;
    for (int i = box.first; i < box.first + box.count; ++i) {
      const auto t = meets_triangle(triangles_[order_[i]], origin, direction);
      if (t && *t > t_min && counts(order_[i], *t)) return true;
    }
    if (box.left >= 0) open.insert(open.end(), {box.left, box.right});
  }
  return false;
}

}  // namespace clatter::recover
