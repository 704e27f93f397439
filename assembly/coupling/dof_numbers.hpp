// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers (ids) of the DoFs before anything is eliminated: displacements of nodes first, then
// reference points, then rotations of nodes, then the own coordinates of reduced parts.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/matrix.hpp"
#include "core/fe/axes.hpp"

namespace clatter::assembly {

using fe::kDofNames;

/// A reference point with six DoFs. One on a mesh node shares the node's displacements, and its
/// rotations where it has some.
struct ReferencePoint {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
  int32_t node = -1;                                   // mesh node, or -1
};

/// A node or a point that has DoFs: index >= 0 is a node, else point -1 - index.
struct NodeOrPoint {
  int32_t index = 0;
  static NodeOrPoint of_node(int32_t node) { return {node}; }
  static NodeOrPoint of_point(int32_t point) { return {-1 - point}; }
  bool is_point() const { return index < 0; }
  int32_t point() const { return -1 - index; }
};

/// Ids: node a has 3 a + d; point p has 3 n_nodes + 6 p + d, except for what a point on a node
/// shares with it; rotation d of the k-th turning node has 3 n_nodes + 6 n_points + 3 k + d; the
/// own coordinates of reduced parts are the last. Generalised coordinates follow.
class DofNumbers {
 public:
  /// @param turning nodes with rotations, ascending. @param own number of those of parts.
  DofNumbers(const RowMatrix& nodes, const std::vector<ReferencePoint>& points,
             std::vector<int32_t> turning = {}, int64_t own = 0)
      : nodes_(nodes), points_(points), turning_(std::move(turning)), own_(own) {}

  int64_t nodal() const { return 3 * nodes_.rows(); }
  int64_t first_rotation() const { return nodal() + 6 * static_cast<int64_t>(points_.size()); }
  int64_t first_own() const { return first_rotation() + 3 * static_cast<int64_t>(turning_.size()); }
  int64_t count() const { return first_own() + own_; }
  /// The ids of nodes: first and one past the last of displacements, and of rotations.
  std::vector<std::pair<int64_t, int64_t>> of_nodes() const {
    return {{0, nodal()}, {first_rotation(), first_own()}};
  }
  const std::vector<int32_t>& turning() const { return turning_; }
  /// The first of the three rotations of a node, -1 for a node of solids.
  int32_t rotation_of(int32_t node) const;
  /// DoF d (0 ... 5) of a point.
  int32_t of_point(int32_t point, int d) const;
  /// DoF d of a node or point, -1 for a rotation of a node of solids.
  int32_t of(NodeOrPoint owner, int d) const;
  Eigen::Vector3d position(NodeOrPoint owner) const;
  /// "node 17 x", "point hub rx"; `node_ids` (Mesh::node_ids) are the numbers in the user's deck;
  /// empty: counted from one.
  std::string name(int32_t id, const std::vector<int32_t>& node_ids) const;
  const std::vector<ReferencePoint>& points() const { return points_; }

 private:
  const RowMatrix& nodes_;
  const std::vector<ReferencePoint>& points_;
  std::vector<int32_t> turning_;
  int64_t own_;
};

}  // namespace clatter::assembly
