// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/repair/cell_graph.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {
namespace {

bool is_positive(const Eigen::Matrix<double, 4, 3>& x) {
  const Eigen::Vector3d a = x.row(1) - x.row(0), b = x.row(2) - x.row(0), c = x.row(3) - x.row(0);
  return a.dot(b.cross(c)) > 0.0;
}

}  // namespace

CellGraph::CellGraph(const Mesh& mesh) {
  const auto n = static_cast<size_t>(mesh.nodes.rows());
  fixed_.assign(n, false);
  around_.resize(n);
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    points_.emplace_back(mesh.nodes.row(i).transpose());
  }
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    if (block.type != CellType::kTet4) throw InputError("cell graph: expected a tet4 mesh");
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      add_cell({block.nodes(c, 0), block.nodes(c, 1), block.nodes(c, 2), block.nodes(c, 3)},
               static_cast<int>(b));
    }
    // Faces between blocks are boundaries of the geometry too.
    Mesh alone;
    alone.cells = {block};
    for (const auto& [corners, face] : boundary_faces(alone)) {
      const auto [none, i, j, k] = corners;  // a triangle's, ascending
      boundary_edges_.insert({i, j});
      boundary_edges_.insert({j, k});
      boundary_edges_.insert({i, k});
      for (int32_t node : {i, j, k}) fixed_[node] = true;
    }
  }
}

std::vector<size_t> CellGraph::around_edge(int32_t a, int32_t b) const {
  std::vector<size_t> found;
  for (size_t c : around(a)) {
    if (std::find(cells_[c].begin(), cells_[c].end(), b) != cells_[c].end()) found.push_back(c);
  }
  return found;
}

bool CellGraph::boundary_edge(int32_t a, int32_t b) const {
  return boundary_edges_.contains({std::min(a, b), std::max(a, b)});
}

int32_t CellGraph::add_node(const Eigen::Vector3d& x) {
  points_.push_back(x);
  fixed_.push_back(false);
  around_.emplace_back();
  return node_count() - 1;
}

void CellGraph::remove_last_node() {
  points_.pop_back();
  fixed_.pop_back();
  around_.pop_back();
}

void CellGraph::add_cell(const TetCorners& corners, int block) {
  for (int32_t node : corners) around_[node].push_back(cells_.size());
  cells_.push_back(corners);
  block_.push_back(block);
  alive_.push_back(true);
}

void CellGraph::remove_cell(size_t cell) {
  alive_[cell] = false;
  for (int32_t node : cells_[cell]) std::erase(around_[node], cell);
}

Eigen::Matrix<double, 4, 3> CellGraph::positions_of(const TetCorners& corners) const {
  Eigen::Matrix<double, 4, 3> x;
  for (int i = 0; i < 4; ++i) x.row(i) = point(corners[i]).transpose();
  return x;
}

double CellGraph::angle(const TetCorners& corners, double limit_deg) const {
  const Eigen::Matrix<double, 4, 3> x = positions_of(corners);
  return is_positive(x) ? smallest_dihedral(x, limit_deg) : -1.0;
}

double CellGraph::cosine(const TetCorners& corners) const {
  const Eigen::Matrix<double, 4, 3> x = positions_of(corners);
  return is_positive(x) ? largest_cosine(x) : 2.0;
}

void CellGraph::store(Mesh& mesh) const {
  mesh.nodes.resize(node_count(), 3);
  for (int32_t i = 0; i < node_count(); ++i) mesh.nodes.row(i) = point(i).transpose();
  std::vector<std::vector<TetCorners>> by_block(mesh.cells.size());
  for (size_t c = 0; c < cells_.size(); ++c) {
    if (alive_[c]) by_block[block_[c]].push_back(cells_[c]);
  }
  for (size_t b = 0; b < by_block.size(); ++b) {
    mesh.cells[b].nodes =
        Eigen::Map<const IndexMatrix>(by_block[b].empty() ? nullptr : by_block[b].front().data(),
                                      static_cast<Eigen::Index>(by_block[b].size()), 4);
  }
}

}  // namespace clatter::mesh
