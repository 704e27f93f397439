// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mid_side_nodes.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::mesh {

std::vector<std::array<int32_t, 2>> ends_of_mid_side_nodes(const Mesh& mesh,
                                                           std::span<const int32_t> nodes,
                                                           const std::string& where) {
  constexpr int32_t kNotWanted = -1, kOpen = -2;
  std::vector<std::array<int32_t, 2>> ends(static_cast<size_t>(mesh.nodes.rows()),
                                           {kNotWanted, kNotWanted});
  for (const int32_t node : nodes) ends[node] = {kOpen, kOpen};
  for (const CellBlock& block : mesh.cells) {
    const CellTraits& cell = traits(block.type);
    if (cell.order != 2) continue;
    for (const auto& row : block.nodes.rowwise())
      for (size_t e = 0; e < cell.edges.size(); ++e) {
        auto& pair = ends[row(cell.corners + static_cast<Eigen::Index>(e))];
        if (pair[0] == kOpen) pair = {row(cell.edges[e][0]), row(cell.edges[e][1])};
      }
  }
  std::vector<std::array<int32_t, 2>> found;
  for (const int32_t node : nodes) {
    found.push_back(ends[node]);
    if (found.back()[0] != kOpen) continue;
    throw InputError(fmt::format("{}: node {} is not a mid-side node, expected mid-side nodes",
                                 where, mesh.node_ids.empty() ? node : mesh.node_ids[node]));
  }
  return found;
}

}  // namespace clatter::mesh
