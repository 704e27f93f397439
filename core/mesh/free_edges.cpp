// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/free_edges.hpp"

#include <algorithm>
#include <map>

namespace clatter::mesh {

std::vector<ShellSide> free_edges(const std::vector<ShellBlock>& shells) {
  std::map<std::pair<int32_t, int32_t>, std::pair<ShellSide, int>> sides;
  for (size_t block = 0; block < shells.size(); ++block) {
    const IndexMatrix& cells = shells[block].nodes;
    const int corners = traits(shells[block].type).corners;
    for (Eigen::Index c = 0; c < cells.rows(); ++c)
      for (Eigen::Index i = 0; i < corners; ++i) {
        const int32_t a = cells(c, i), b = cells(c, (i + 1) % corners);
        ++sides.try_emplace(std::minmax(a, b), ShellSide{block, c, i, a, b}, 0)
              .first->second.second;
      }
  }
  std::vector<ShellSide> free;
  for (const auto& [nodes, side] : sides)
    if (side.second == 1) free.push_back(side.first);
  return free;
}

}  // namespace clatter::mesh
