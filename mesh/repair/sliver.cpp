// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/sliver.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/mesh/boundary.hpp"
#include "mesh/repair/cell_graph.hpp"
#include "mesh/repair/pattern_search.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

constexpr int kSliverSweeps = 8;
constexpr double kSliverFirstStep = 0.25;  // of the mean edge around the node
constexpr double kWorthwhile = 0.5;        // smallest gain of an edit, degrees
constexpr double kBlunt = 100.0;           // degrees: above the edges of boxes

/// The smallest dihedral angle of some cells, evaluated repeatedly while one of their nodes moves.
class SmallestAngle {
 public:
  SmallestAngle(const CellGraph& graph, std::vector<TetCorners> cells)
      : graph_(graph), cells_(std::move(cells)), cosines_(cells_.size()) {}

  /// Exact where it is above `best` [deg]; else some angle that is not.
  double operator()(double best) {
    const double enough = best > 0.0 ? std::cos(best * std::numbers::pi / 180.0) : 1.0;
    double largest = -1.0;
    for (size_t c = 0; c < cells_.size(); ++c) {
      cosines_[c] = graph_.cosine(cells_[c]);
      if (cosines_[c] > enough + kCosineError && best >= -1.0) {
        std::swap(cells_[c], cells_.front());  // it usually ends the next search too
        return best;
      }
      if (cosines_[c] > largest) largest = cosines_[c];
    }
    // Inverse tangents only for the cells that can have the smallest angle.
    double smallest = 180.0;
    for (size_t c = 0; c < cells_.size(); ++c)
      if (!(cosines_[c] < largest - 2.0 * kCosineError))
        smallest = std::min(smallest, graph_.angle(cells_[c]));
    return smallest;
  }

 private:
  const CellGraph& graph_;
  std::vector<TetCorners> cells_;
  std::vector<double> cosines_;
};

double mean_edge_at(const CellGraph& graph, int32_t node, const std::vector<TetCorners>& cells) {
  double sum = 0.0;
  for (const TetCorners& cell : cells) {
    for (int32_t other : cell) sum += (graph.point(other) - graph.point(node)).norm();
  }
  return sum / (3.0 * static_cast<double>(cells.size()));
}

struct GraphNode {
  CellGraph& graph;
  int32_t node;
  Vector3d get() const { return graph.point(node); }
  void set(const Vector3d& x) { graph.point(node) = x; }
};

// Moves the node to where the smallest angle of `cells`, all around it, is largest; that angle.
double move_node(CellGraph& graph, int32_t node, const std::vector<TetCorners>& cells) {
  return search_position(GraphNode{graph, node},
                         kSliverFirstStep * mean_edge_at(graph, node, cells),
                         SmallestAngle(graph, cells));
}

std::vector<TetCorners> corners_around(const CellGraph& graph, int32_t node) {
  std::vector<TetCorners> cells;
  for (size_t c : graph.around(node)) cells.push_back(graph.cell(c));
  return cells;
}

using Edge = std::array<int32_t, 2>;

/// Edges that get a common node, with the removed and added cells.
struct Split {
  std::vector<size_t> removed;
  std::vector<TetCorners> added;
  Vector3d position;
  double angle = -2.0;
};

TetCorners with(TetCorners cell, int32_t old_node, int32_t new_node) {
  std::replace(cell.begin(), cell.end(), old_node, new_node);
  return cell;
}

// Tries one node on all of `edges` (one edge, or both diagonals of the cell, which is then
// removed).
Split try_split(CellGraph& graph, size_t cell, const std::vector<Edge>& edges) {
  Split split;
  Vector3d middle = Vector3d::Zero();
  for (const auto& [a, b] : edges) middle += graph.point(a) + graph.point(b);
  const int32_t node = graph.add_node(middle / (2.0 * static_cast<double>(edges.size())));
  for (const auto& [a, b] : edges) {
    for (size_t c : graph.around_edge(a, b)) {
      split.removed.push_back(c);
      if (c == cell && edges.size() == 2) continue;
      split.added.push_back(with(graph.cell(c), a, node));
      split.added.push_back(with(graph.cell(c), b, node));
    }
  }
  std::sort(split.removed.begin(), split.removed.end());
  split.removed.erase(std::unique(split.removed.begin(), split.removed.end()), split.removed.end());
  split.angle = move_node(graph, node, split.added);
  split.position = graph.point(node);
  graph.remove_last_node();
  return split;
}

void apply(CellGraph& graph, const Split& split, int block) {
  graph.add_node(split.position);
  for (size_t c : split.removed) graph.remove_cell(c);
  for (const TetCorners& corners : split.added) graph.add_cell(corners, block);
}

std::vector<std::vector<Edge>> splittable(const CellGraph& graph, size_t cell) {
  constexpr std::array<std::array<int, 2>, 3> kOpposite = {{{0, 4}, {1, 3}, {2, 5}}};
  const TetCorners& x = graph.cell(cell);
  const auto edge = [&](int e) { return Edge{x[kTetEdges[e][0]], x[kTetEdges[e][1]]}; };
  const auto inner = [&](int e) { return !graph.boundary_edge(edge(e)[0], edge(e)[1]); };
  std::vector<std::vector<Edge>> choices;
  for (const auto& [e, f] : kOpposite) {
    if (inner(e) && inner(f)) choices.push_back({edge(e), edge(f)});
  }
  for (int e = 0; e < 6; ++e) {
    if (inner(e)) choices.push_back({edge(e)});
  }
  return choices;
}

bool split_cell(CellGraph& graph, size_t cell) {
  const double before = graph.angle(graph.cell(cell));
  Split best;
  for (const auto& edges : splittable(graph, cell)) {
    Split split = try_split(graph, cell, edges);
    if (split.angle > best.angle) best = std::move(split);
  }
  if (best.angle < before + kWorthwhile) return false;
  apply(graph, best, graph.block_of(cell));
  return true;
}

std::vector<size_t> cells_below(const CellGraph& graph, double target_deg) {
  std::vector<size_t> found;
  for (size_t c = 0; c < graph.cell_count(); ++c) {
    if (graph.alive(c) && graph.angle(graph.cell(c), target_deg) < target_deg) found.push_back(c);
  }
  return found;
}

// One pass over the bad cells: first its nodes move, then, if that is not enough, an edge splits.
bool sweep(CellGraph& graph, const std::vector<size_t>& bad, double target_deg) {
  bool changed = false;
  for (size_t c : bad) {
    if (!graph.alive(c)) continue;
    const TetCorners corners = graph.cell(c);
    const double before = graph.angle(corners);
    for (int32_t node : corners) {
      if (!graph.fixed(node)) move_node(graph, node, corners_around(graph, node));
    }
    changed = changed || graph.angle(corners) > before;
    if (graph.angle(corners) < target_deg) changed = split_cell(graph, c) || changed;
  }
  return changed;
}

// The cell's nodes in the graph, and the edge opposite to the one between its boundary faces.
struct Blunt {
  size_t cell;
  Edge opposite;
};

// Each block has its own boundary: regions share curved faces too.
std::vector<Blunt> blunt_corners(const Mesh& mesh) {
  std::vector<Blunt> found;
  size_t first = 0;
  for (const CellBlock& block : mesh.cells) {
    Mesh alone;
    alone.cells = {block};
    std::map<int32_t, std::vector<FaceKey>> faces;
    for (const auto& [key, face] : boundary_faces(alone)) faces[face.cell].push_back(key);
    for (const auto& [c, faces_of_c] : faces) {
      const std::vector<FaceKey>& keys = faces_of_c;
      if (keys.size() != 2) continue;
      Eigen::Matrix<double, 4, 3> x;
      for (int i = 0; i < 4; ++i) x.row(i) = mesh.nodes.row(block.nodes(c, i));
      const auto angles = dihedral_angles(x);
      const auto in_both = [&](int32_t node) {
        return std::all_of(keys.begin(), keys.end(), [&](const FaceKey& key) {
          return std::find(key.begin(), key.end(), node) != key.end();
        });
      };
      for (int e = 0; e < 6; ++e) {
        const int32_t a = block.nodes(c, kTetEdges[e][0]), b = block.nodes(c, kTetEdges[e][1]);
        if (angles[e] < kBlunt || !in_both(a) || !in_both(b)) continue;
        Edge opposite;
        std::copy_if(block.nodes.row(c).begin(), block.nodes.row(c).end(), opposite.begin(),
                     [&](int32_t node) { return node != a && node != b; });
        found.push_back({first + static_cast<size_t>(c), opposite});
      }
    }
    first += static_cast<size_t>(block.nodes.rows());
  }
  return found;
}

}  // namespace

int64_t split_blunt_corners(Mesh& mesh, double least_deg) {
  CellGraph graph(mesh);
  int64_t count = 0;
  for (const Blunt& blunt : blunt_corners(mesh)) {
    const auto [c, d] = blunt.opposite;
    if (!graph.alive(blunt.cell) || graph.boundary_edge(c, d)) continue;
    const Split split = try_split(graph, blunt.cell, {blunt.opposite});
    if (split.angle < least_deg) continue;
    apply(graph, split, graph.block_of(blunt.cell));
    ++count;
  }
  graph.store(mesh);
  return count;
}

SliverReport lift_slivers(Mesh& mesh, double target_deg) {
  CellGraph graph(mesh);
  std::vector<size_t> bad = cells_below(graph, target_deg);
  SliverReport report;
  report.before = static_cast<int64_t>(bad.size());
  for (int i = 0; i < kSliverSweeps && !bad.empty(); ++i) {
    const bool changed = sweep(graph, bad, target_deg);
    bad = cells_below(graph, target_deg);
    if (!changed) break;
  }
  report.after = static_cast<int64_t>(bad.size());
  report.new_nodes = graph.node_count() - mesh.nodes.rows();
  graph.store(mesh);
  return report;
}

}  // namespace clatter::mesh
