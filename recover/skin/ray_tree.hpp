// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Ray intersection test by a tree of boxes around flat triangles.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace clatter::recover {

using Triangle = Eigen::Matrix3d;  // columns are the corners [m]

class RayTree {
 public:
  explicit RayTree(std::vector<Triangle> triangles);

  /// True when the ray origin + t * direction, t > t_min, hits a triangle. Unit `direction`.
  bool hits(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double t_min) const;

 private:
  struct Box {
    Eigen::AlignedBox3d extent;
    int first = 0, count = 0;  // triangles of a leaf
    int left = -1, right = -1;
  };
  int build(int first, int count);

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
};

}  // namespace clatter::recover
