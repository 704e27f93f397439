// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The face that is nearest to a point, of shells or of given nodes.
#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// A face by its nodes.
struct NodeFace {
  FaceType type = FaceType::kQuad4;
  std::array<int32_t, kMaxFaceNodes> nodes{};
};

/// A point of a face.
struct FacePoint {
  NodeFace face;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // r, s of the reference face
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit
  double distance = 0.0;
  size_t block = 0;       // of a shell
  Eigen::Index row = -1;  // -1: of none
};

/// The point of a face that is nearest to `point`, of its edges too.
FacePoint nearest_point(const NodeFace& face, const RowMatrix& nodes, const Eigen::Vector3d& point);

/// Shells in boxes of about their size.
class ShellSearch {
 public:
  explicit ShellSearch(const Mesh& mesh);

  /// The nearest point of the shells that `takes` accepts by their block and row, within `reach`.
  std::optional<FacePoint> nearest(
      const Eigen::Vector3d& point, double reach,
      const std::function<bool(size_t block, Eigen::Index row)>& takes) const;
  /// Mean extent of the shells; 0 without any.
  double size() const { return size_; }

 private:
  using Box = std::array<int64_t, 3>;
  struct Cell {
    size_t block;
    Eigen::Index row;
  };
  Box box_of(const Eigen::Vector3d& at) const;
  /// How many boxes lie between two, as they may be too many for an integer.
  static double boxes_between(const Box& first, const Box& last);

  const Mesh& mesh_;
  double size_ = 0.0;
  std::map<Box, std::vector<Cell>> cells_;
  std::vector<Cell> large_;  // in too many boxes
};

}  // namespace clatter::mesh::deck
