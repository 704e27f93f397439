// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/cluster.hpp"

#include <algorithm>
#include <tuple>

namespace clatter::assembly {
namespace {

using Iterator = std::vector<int32_t>::iterator;

void bisect(const RowMatrix& coordinates, Iterator first, Iterator last, size_t limit,
            std::vector<std::vector<int32_t>>& groups) {
  const auto count = static_cast<size_t>(last - first);
  if (count <= limit) {
    groups.emplace_back(first, last);
    return;
  }
  Eigen::RowVector3d low = coordinates.row(*first), high = low;
  for (Iterator node = first; node != last; ++node) {
    low = low.cwiseMin(coordinates.row(*node));
    high = high.cwiseMax(coordinates.row(*node));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const Iterator middle = first + static_cast<std::ptrdiff_t>(count / 2);
  // Equal coordinates are ordered by the other two, so that groups do not depend on node numbers.
  const auto key = [&](int32_t node) {
    return std::tuple(coordinates(node, axis), coordinates(node, (axis + 1) % 3),
                      coordinates(node, (axis + 2) % 3), node);
  };
  std::sort(first, last, [&](int32_t a, int32_t b) { return key(a) < key(b); });
  bisect(coordinates, first, middle, limit, groups);
  bisect(coordinates, middle, last, limit, groups);
}

}  // namespace

std::vector<std::vector<int32_t>> cluster_nodes(const RowMatrix& coordinates,
                                                const std::vector<int32_t>& nodes, size_t limit) {
  std::vector<int32_t> order = nodes;
  std::vector<std::vector<int32_t>> groups;
  if (!order.empty()) bisect(coordinates, order.begin(), order.end(), limit, groups);
  return groups;
}

}  // namespace clatter::assembly
