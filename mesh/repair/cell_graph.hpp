// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A linear tetrahedral mesh that can be edited: nodes move, cells come and go.
#include <Eigen/Core>
#include <array>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

using TetCorners = std::array<int32_t, 4>;

/// Cells, and for each node the cells around it. Removed cells keep their number, marked dead.
class CellGraph {
 public:
  explicit CellGraph(const Mesh& mesh);

  size_t cell_count() const { return cells_.size(); }  // dead ones included
  bool alive(size_t cell) const { return alive_[cell]; }
  const TetCorners& cell(size_t cell) const { return cells_[cell]; }
  int block_of(size_t cell) const { return block_[cell]; }
  const std::vector<size_t>& around(int32_t node) const { return around_[node]; }
  /// Cells that have both nodes.
  std::vector<size_t> around_edge(int32_t a, int32_t b) const;
  /// On the boundary of a block: must not move.
  bool fixed(int32_t node) const { return fixed_[node]; }
  /// On the boundary of a block: must not be split.
  bool boundary_edge(int32_t a, int32_t b) const;

  Eigen::Vector3d& point(int32_t node) { return points_[node]; }
  const Eigen::Vector3d& point(int32_t node) const { return points_[node]; }
  int32_t node_count() const { return static_cast<int32_t>(points_.size()); }

  int32_t add_node(const Eigen::Vector3d& x);
  void remove_last_node();  // only while it has no cells
  void add_cell(const TetCorners& corners, int block);
  void remove_cell(size_t cell);

  /// Smallest dihedral angle [deg]; -1 for a flat or inverted cell.
  double angle(const TetCorners& corners) const { return angle(corners, 180.0); }
  /// The same where it is below `limit_deg`, else some angle that is not (smallest_dihedral()).
  double angle(const TetCorners& corners, double limit_deg) const;
  /// largest_cosine() of the cell; 2 for a flat or inverted cell.
  double cosine(const TetCorners& corners) const;

  /// Writes nodes and cells back into a mesh of the same blocks.
  void store(Mesh& mesh) const;

 private:
  Eigen::Matrix<double, 4, 3> positions_of(const TetCorners& corners) const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<TetCorners> cells_;
  std::vector<int> block_;
  std::vector<bool> alive_, fixed_;
  std::vector<std::vector<size_t>> around_;
  std::set<std::pair<int32_t, int32_t>> boundary_edges_;
};

}  // namespace clatter::mesh
