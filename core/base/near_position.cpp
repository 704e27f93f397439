// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/near_position.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"

namespace clatter {

double size_around(const RowMatrix& nodes, const IndexMatrix& cells, int32_t node) {
  double size = 0.0;
  for (Eigen::Index c = 0; c < cells.rows(); ++c) {
    if (std::find(cells.row(c).begin(), cells.row(c).end(), node) == cells.row(c).end()) continue;
    Eigen::AlignedBox3d box;
    for (const int32_t other : cells.row(c))
      box.extend(Eigen::Vector3d(nodes.row(other).transpose()));
    size = std::max(size, box.diagonal().norm());
  }
  return size;
}

void require_near(const std::string& what, const Eigen::Vector3d& requested,
                  const Eigen::Vector3d& found, double size, const std::string& unit) {
  const double distance = (found - requested).norm();
  const std::string where =
      fmt::format("{} lies at ({:.5g}, {:.5g}, {:.5g}) m, {:.3g} mm from the requested position",
                  what, found.x(), found.y(), found.z(), distance / kMilli);
  if (distance <= size || size == 0.0) {
    say(where);
    return;
  }
  std::string other = fmt::format("positions are in {}", unit);
  for (const auto& [factor, name] : {std::pair{kMilli, "millimetres"}, {1.0 / kMilli, "metres"}})
    if ((found - factor * requested).norm() <= size)
      other += fmt::format(", this one fits in {}", name);
  throw InputError(fmt::format("{}, expected at most an element's size there, {:.3g} mm: {}", where,
                               size / kMilli, other));
}

}  // namespace clatter
