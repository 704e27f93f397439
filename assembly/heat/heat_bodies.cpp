// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/heat/heat_bodies.hpp"

namespace clatter::assembly {

HeatBodies::HeatBodies(const mesh::Mesh& mesh) : parent_(static_cast<size_t>(mesh.nodes.rows())) {
  std::iota(parent_.begin(), parent_.end(), 0);
  const auto join_cells = [&](const auto& blocks) {
    for (const auto& block : blocks)
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
        for (Eigen::Index a = 1; a < block.nodes.cols(); ++a)
          join(block.nodes(c, 0), block.nodes(c, a));
  };
  join_cells(mesh.cells);
  join_cells(mesh.shells);
}

int32_t HeatBodies::root(int32_t node) const {
  auto at = static_cast<size_t>(node);
  while (parent_[at] != static_cast<int32_t>(at)) {
    parent_[at] = parent_[parent_[at]];
    at = static_cast<size_t>(parent_[at]);
  }
  return static_cast<int32_t>(at);
}

void HeatBodies::join(int32_t a, int32_t b) { parent_[root(a)] = root(b); }

std::optional<int32_t> HeatBodies::first_loose() const {
  std::vector<bool> held(parent_.size(), false);
  for (const int32_t node : fixed_) held[root(node)] = true;
  for (size_t a = 0; a < parent_.size(); ++a)
    if (!held[root(static_cast<int32_t>(a))]) return static_cast<int32_t>(a);
  return std::nullopt;
}

}  // namespace clatter::assembly
