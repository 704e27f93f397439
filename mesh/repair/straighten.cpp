// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/straighten.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/mesh/boundary.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh {
namespace {

constexpr int kHalvings = 6;  // then straight: a 64th of a bow is negligible

struct Bow {
  Eigen::Vector3d middle, from_middle;  // of the edge; of the node, as it was
  double edge;                          // length
  int halvings = 0;
};

class Bows {
 public:
  explicit Bows(Mesh& mesh) : mesh_(mesh) {}

  // False when all edges of the cell are straight already.
  bool halve(const CellBlock& block, Eigen::Index cell) {
    bool moved = false;
    for (int e = 0; e < 6; ++e) {
      const auto [a, b] = kTetEdges[e];
      const int32_t node = block.nodes(cell, 4 + e);
      Bow& bow = bow_of(node, block.nodes(cell, a), block.nodes(cell, b));
      if (bow.halvings == kHalvings || !this_pass_.insert(node).second) continue;
      ++bow.halvings;
      const double left = bow.halvings == kHalvings ? 0.0 : std::ldexp(1.0, -bow.halvings);
      mesh_.nodes.row(node) = (bow.middle + left * bow.from_middle).transpose();
      moved = true;
    }
    return moved;
  }
  void next_pass() { this_pass_.clear(); }

  std::vector<PulledNode> pulled(const std::vector<int32_t>& skin) const {
    std::vector<PulledNode> nodes;
    for (const auto& [node, bow] : bows_) {
      const Eigen::Vector3d was = bow.middle + bow.from_middle;
      const double distance = (mesh_.nodes.row(node).transpose() - was).norm();
      if (distance > 0.0 && std::binary_search(skin.begin(), skin.end(), node))
        nodes.push_back({node, distance, bow.edge});
    }
    std::stable_sort(nodes.begin(), nodes.end(),
                     [](const auto& a, const auto& b) { return a.distance > b.distance; });
    return nodes;
  }

 private:
  Bow& bow_of(int32_t node, int32_t a, int32_t b) {
    const auto [at, is_new] = bows_.try_emplace(node);
    if (is_new) {
      const Eigen::Vector3d from = mesh_.nodes.row(a), to = mesh_.nodes.row(b);
      at->second.middle = 0.5 * (from + to);
      at->second.from_middle = mesh_.nodes.row(node).transpose() - at->second.middle;
      at->second.edge = (to - from).norm();
    }
    return at->second;
  }

  Mesh& mesh_;
  std::map<int32_t, Bow> bows_;
  std::set<int32_t> this_pass_;  // an edge of two bad cells is halved once
};

}  // namespace

std::vector<PulledNode> straighten_cells(Mesh& mesh, double floor) {
  Bows bows(mesh);
  for (bool moved = true; moved;) {
    std::vector<std::pair<const CellBlock*, Eigen::Index>> bad;
    for (const CellBlock& block : mesh.cells) {
      if (block.type != CellType::kTet10) continue;
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
        if (jacobian_bounds(tet_nodes(mesh, block, c)).ratio() < floor) bad.emplace_back(&block, c);
    }
    moved = false;
    bows.next_pass();
    for (const auto& [block, cell] : bad) moved = bows.halve(*block, cell) || moved;
  }
  return bows.pulled(nodes_of(skin_of(boundary_faces(mesh))));
}

}  // namespace clatter::mesh
