// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Finds the faces near a box.
#include <Eigen/Geometry>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "assembly/tie/face_geometry.hpp"

namespace clatter::assembly {

/// A uniform grid of cells about as large as the faces.
class FaceSearch {
 public:
  /// Boxes of the faces are enlarged by `distance` [m].
  FaceSearch(const std::vector<TieFace>& faces, double distance);

  /// Faces whose enlarged boxes intersect the box, ascending.
  std::vector<int32_t> near(const Eigen::AlignedBox3d& box) const;

 private:
  using Cell = Eigen::Matrix<int64_t, 3, 1>;
  Cell cell_of(const Eigen::Vector3d& x) const;
  /// Calls visit(key) for each cell that the box intersects.
  template <typename Visit>
  void each_cell(const Eigen::AlignedBox3d& box, const Visit& visit) const;

  std::vector<Eigen::AlignedBox3d> boxes_;
  double size_ = 1.0;  // of a cell [m]
  std::unordered_map<uint64_t, std::vector<int32_t>> cells_;
};

/// The bounding box of a face's nodes. Curved faces exceed it by less than their own size.
Eigen::AlignedBox3d box_of(const TieFace& face);

}  // namespace clatter::assembly
