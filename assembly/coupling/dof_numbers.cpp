// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/dof_numbers.hpp"

#include <fmt/format.h>

namespace clatter::assembly {

int32_t DofNumbers::of_point(int32_t point, int d) const {
  const int32_t node = points_[point].node;
  if (node >= 0 && d < 3) return 3 * node + d;
  return static_cast<int32_t>(nodal()) + 6 * point + d;
}

int32_t DofNumbers::of(NodeOrPoint owner, int d) const {
  if (owner.is_point()) return of_point(owner.point(), d);
  return d < 3 ? 3 * owner.index + d : -1;
}

Eigen::Vector3d DofNumbers::position(NodeOrPoint owner) const {
  if (owner.is_point()) return points_[owner.point()].position;
  return nodes_.row(owner.index).transpose();
}

std::string DofNumbers::name(int32_t id, const std::vector<int32_t>& node_ids) const {
  if (id < nodal()) {
    const auto node = static_cast<size_t>(id / 3);
    const int32_t number = node < node_ids.size() ? node_ids[node] : id / 3 + 1;
    return fmt::format("node {} {}", number, kDofNames[id % 3]);
  }
  if (id >= count()) return fmt::format("generalised coordinate {}", id - count());
  const auto at = static_cast<size_t>(id - nodal());
  return fmt::format("point {} {}", points_[at / 6].name, kDofNames[at % 6]);
}

}  // namespace clatter::assembly
