// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/dof_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::assembly {

int32_t DofNumbers::rotation_of(int32_t node) const {
  const auto found = std::ranges::lower_bound(turning_, node);
  if (found == turning_.end() || *found != node) return -1;
  return static_cast<int32_t>(first_rotation() + 3 * (found - turning_.begin()));
}

int32_t DofNumbers::of_point(int32_t point, int d) const {
  const int32_t node = points_[point].node;
  const int32_t shared = node < 0 ? -1 : of(NodeOrPoint::of_node(node), d);
  return shared >= 0 ? shared : static_cast<int32_t>(nodal()) + 6 * point + d;
}

int32_t DofNumbers::of(NodeOrPoint owner, int d) const {
  if (owner.is_point()) return of_point(owner.point(), d);
  if (d < 3) return 3 * owner.index + d;
  const int32_t first = rotation_of(owner.index);
  return first < 0 ? -1 : first + d - 3;
}

Eigen::Vector3d DofNumbers::position(NodeOrPoint owner) const {
  if (owner.is_point()) return points_[owner.point()].position;
  return nodes_.row(owner.index).transpose();
}

std::string DofNumbers::name(int32_t id, const std::vector<int32_t>& node_ids) const {
  const auto of_node = [&](int32_t node, int64_t d) {
    const auto at = static_cast<size_t>(node);
    return fmt::format("node {} {}", at < node_ids.size() ? node_ids[at] : node + 1, kDofNames[d]);
  };
  if (id < nodal()) return of_node(id / 3, id % 3);
  if (const int64_t rotation = id - first_rotation(); rotation >= 0 && id < first_own())
    return of_node(turning_[static_cast<size_t>(rotation / 3)], 3 + rotation % 3);
  if (id >= first_own() && id < count())
    return fmt::format("coordinate {} of the reduced parts", id - first_own());
  if (id >= count()) return fmt::format("generalised coordinate {}", id - count());
  const auto at = static_cast<size_t>(id - nodal());
  return fmt::format("point {} {}", points_[at / 6].name, kDofNames[at % 6]);
}

}  // namespace clatter::assembly
