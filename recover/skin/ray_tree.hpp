// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Ray intersection test by a tree of boxes around flat triangles.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

namespace clatter::recover {

using Triangle = Eigen::Matrix3d;  // columns are the corners [m]

class RayTree {
 public:
  explicit RayTree(std::vector<Triangle> triangles);

  /// Whether a hit counts: the triangle's place in the constructor's list, and t.
  using Counts = std::function<bool(int32_t triangle, double t)>;

  /// True when the ray origin + t * direction, t > t_min, has a hit that counts. Unit `direction`.
  bool hits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double t_min,
            const Counts& counts) const;

 private:
  struct Box {
    Eigen::AlignedBox3d extent;
    int first = 0, count = 0;  // triangles of a leaf
    int left = -1, right = -1;
  };
  int build(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<int32_t> order_;  // places in triangles_, by leaves
  std::vector<Box> boxes_;
};

}  // namespace clatter::recover
