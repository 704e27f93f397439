// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/circle_tree.hpp"

#include <algorithm>

namespace clatter::dynamics {
namespace {

/// The smallest circle around two.
Circle around(const Circle& a, const Circle& b) {
  const Eigen::Vector2d apart = b.centre - a.centre;
  const double distance = apart.norm();
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const double radius = 0.5 * (distance + a.radius + b.radius);
  return {a.centre + (radius - a.radius) / distance * apart, radius};
}

}  // namespace

CircleTree::CircleTree(const std::vector<Circle>& cells) { add(cells, 0, cells.size()); }

Circle CircleTree::add(const std::vector<Circle>& cells, size_t begin, size_t end) {
  const size_t index = nodes_.size();
  nodes_.push_back({cells[begin], 0, static_cast<int>(begin)});
  if (end - begin > 1) {
    const size_t middle = begin + (end - begin) / 2;
    const Circle first = add(cells, begin, middle);
    nodes_[index].circle = around(first, add(cells, middle, end));
    nodes_[index].cell = -1;
  }
  nodes_[index].next = static_cast<int>(nodes_.size());
  return nodes_[index].circle;
}

}  // namespace clatter::dynamics
