// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Bounding circles of cells in a binary tree.
#include <Eigen/Core>
#include <vector>

namespace clatter::dynamics {

struct Circle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

/// Circles around cells, around neighbouring pairs of them, and so on up to one around all. The
/// nodes are stored in depth-first order with the number of the node that follows each subtree, so
/// that a search is one loop without a stack and meets the cells in their order.
class CircleTree {
 public:
  struct Node {
    Circle circle;
    int next;  // node after this subtree
    int cell;  // of a leaf, otherwise -1
  };

  CircleTree() = default;
  /// @param cells the circle of each, at least one.
  explicit CircleTree(const std::vector<Circle>& cells);

  const std::vector<Node>& nodes() const { return nodes_; }

 private:
  Circle add(const std::vector<Circle>& cells, size_t begin, size_t end);
  std::vector<Node> nodes_;
};

}  // namespace clatter::dynamics
