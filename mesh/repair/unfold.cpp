// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/unfold.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/boundary.hpp"
#include "core/mesh/validity.hpp"
#include "mesh/repair/pattern_search.hpp"

namespace clatter::mesh {
namespace {

constexpr int kUnfoldSweeps = 10;
constexpr double kUnfoldFirstStep = 0.1;  // of the cell's size: mid-side nodes can move little

using CellId = std::pair<size_t, Eigen::Index>;  // block, row

class CurvedCells {
 public:
  CurvedCells(Mesh& mesh, const Sliding& sliding) : mesh_(mesh), sliding_(sliding) {
    const auto n = static_cast<size_t>(mesh.nodes.rows());
    fixed_.assign(n, false);
    around_.resize(n);
    for (size_t b = 0; b < mesh.cells.size(); ++b) {
      const CellBlock& block = mesh.cells[b];
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        for (Eigen::Index i = 0; i < block.nodes.cols(); ++i) {
          around_[block.nodes(c, i)].push_back({b, c});
        }
      }
      Mesh alone;
      alone.cells = {block};
      for (const auto& entry : boundary_faces(alone)) {
        for (int32_t node : entry.second.nodes()) fixed_[node] = true;
      }
    }
  }

  double ratio(const CellId& id) const {
    return jacobian_bounds(tet_nodes(mesh_, mesh_.cells[id.first], id.second)).ratio();
  }

  std::vector<CellId> below(double target) const {
    std::vector<CellId> found;
    for (size_t b = 0; b < mesh_.cells.size(); ++b) {
      for (Eigen::Index c = 0; c < mesh_.cells[b].nodes.rows(); ++c) {
        if (ratio({b, c}) < target) found.push_back({b, c});
      }
    }
    return found;
  }

  // Moves the free nodes of the cell until it is good enough, mid-side nodes before corners: they
  // keep the straight shape. Where the boundary slides and the cell stays folded, those of the
  // cells around it make room. True when the cell improved.
  bool improve(const CellId& id, double target) {
    const double before = ratio(id), size = size_of(id);
    move_own(id, target, size);
    if (!sliding_.nodes.empty() && !(ratio(id) > 0.0)) {
      for (const int32_t node : middles_around(id)) move(node, size);
      move_own(id, target, size);
    }
    return ratio(id) > before;
  }

 private:
  struct Node {
    RowMatrix& nodes;
    int32_t row;
    Eigen::Vector3d get() const { return nodes.row(row).transpose(); }
    void set(const Eigen::Vector3d& x) { nodes.row(row) = x.transpose(); }
  };

  struct SlidingNode : Node {
    const Sliding& sliding;
    void set(const Eigen::Vector3d& x) { Node::set(sliding.onto(row, x)); }
  };

  double size_of(const CellId& id) const {
    return std::cbrt(6.0 * std::abs(volume_of(tet_nodes(mesh_, mesh_.cells[id.first], id.second))));
  }

  void move_own(const CellId& id, double target, double size) {
    const CellBlock& block = mesh_.cells[id.first];
    for (Eigen::Index i = block.nodes.cols() - 1; i >= 0 && ratio(id) < target; --i)
      move(block.nodes(id.second, i), size);
  }

  void move(int32_t node, double size) {
    if (fixed_[node] && !sliding_.nodes.contains(node)) return;
    const auto search = [&](auto point) {
      search_position(point, kUnfoldFirstStep * size, [&](double best) {
        return sliding_.nodes.empty() ? worst_around(node, best) : mean_around(node);
      });
    };
    if (fixed_[node])
      search(SlidingNode{{mesh_.nodes, node}, sliding_});
    else
      search(Node{mesh_.nodes, node});
  }

  // Mid-side nodes of the cells that share a node with this one.
  std::set<int32_t> middles_around(const CellId& id) const {
    std::set<int32_t> found;
    for (const int32_t own : mesh_.cells[id.first].nodes.row(id.second))
      for (const CellId& other : around_[own])
        for (const int32_t node : mesh_.cells[other.first].nodes.row(other.second).tail<6>())
          found.insert(node);
    return found;
  }

  // Exact where it is above `best`. The cell that ends the search goes to the front: it usually
  // ends the next one too.
  double worst_around(int32_t node, double best) {
    double worst = 1.0;
    std::vector<CellId>& cells = around_[node];
    for (CellId& id : cells) {
      worst = std::min(worst, ratio(id));
      if (worst > best) continue;
      std::swap(id, cells.front());
      break;
    }
    return worst;
  }

  // Like the smallest ratio, but with that of each cell: where two cells are as bad, what helps one
  // and does no harm to the other counts, and the search node by node does not stop there.
  double mean_around(int32_t node) const {
    constexpr double kSharp = 30.0;
    double sum = 0.0;
    for (const CellId& id : around_[node]) sum += std::exp(-kSharp * std::max(ratio(id), -20.0));
    return -std::log(sum);
  }

  Mesh& mesh_;
  const Sliding& sliding_;
  std::vector<bool> fixed_;
  std::vector<std::vector<CellId>> around_;
};

}  // namespace

int64_t unfold_cells(Mesh& mesh, double target, const Sliding& sliding) {
  CurvedCells cells(mesh, sliding);
  std::vector<CellId> bad = cells.below(target);
  const auto before = static_cast<int64_t>(bad.size());
  for (int sweep = 0; sweep < kUnfoldSweeps && !bad.empty(); ++sweep) {
    bool better = false;
    for (const CellId& id : bad) better = cells.improve(id, target) || better;
    if (!better) break;
    bad = cells.below(target);
  }
  return before;
}

}  // namespace clatter::mesh
