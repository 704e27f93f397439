// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The faces and open edges over which oil moves between the cells of a pad and out of it.
#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "dynamics/film/edge_volumes.hpp"
#include "dynamics/film/grid.hpp"

namespace clatter::film {

/// Boundary condition at one edge of a pad. Gauge pressure; cavitation pressure is 0.
struct Edge {
  enum class Kind { kPressure, kWall };
  Kind kind = Kind::kPressure;
  double pressure = 0.0;  // [Pa] >= 0, of the oil outside
  double fill = 1.0;      // [1] fill of the oil that is dragged in over this edge, 0 to 1
  /// Thickness t of the oil outside on the wall that slides at 2 U_m past the grid [m]: the inflow
  /// is at most 2 t U_m.
  double layer = std::numeric_limits<double>::infinity();

  static Edge wall() { return {Kind::kWall, 0.0, 0.0, 0.0}; }
  static Edge supply(double pressure, double fill,
                     double layer = std::numeric_limits<double>::infinity()) {
    return {Kind::kPressure, pressure, fill, layer};
  }
};

/// The four edges; a periodic grid has no angular ones. `liner_end` holds where the liner ends
/// inside the pad (Cover).
struct Edges {
  Edge angle_begin, angle_end, axial_begin, axial_end;
  Edge liner_end{};
};

/// Between two cells; flow counts from a to b.
struct Face {
  int a, b;
  double length;    // [m]
  double distance;  // between the centres [m]
  bool axial;
  int beyond_a, beyond_b;  // the next cells along the same line; -1: none
};

/// The part of an open edge at one cell; flow counts outward.
struct Rim {
  int cell;
  double length, distance;  // distance from the centre to the edge [m]
  double sign;              // outward direction along the axis of flow
  bool axial;
  Edge edge;
};

/// Faces and rims of a grid, a permutation of its cells, and sums over flows.
///
/// Flows are listed as: those over each face, over each rim, out of each cell over the end of the
/// liner, and where there are grooves out of each cell into them.
class PadFaces {
 public:
  PadFaces(const PadGrid& grid, const Edges& edges, bool grooves);

  const PadGrid& grid() const { return grid_; }
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Rim>& rims() const { return rims_; }
  const Edge& liner_end() const { return liner_end_; }
  bool grooves() const { return grooves_; }

  /// Row of a cell in a banded matrix over the cells.
  int row(int cell) const { return row_[cell]; }
  /// Largest difference of the rows of two cells with a common face.
  int band() const;

  // Where a list of flows has that over face `f`, over rim `r`, and out of cell `c`.
  static Eigen::Index face_flow(size_t f) { return static_cast<Eigen::Index>(f); }
  Eigen::Index rim_flow(size_t r) const { return static_cast<Eigen::Index>(faces_.size() + r); }
  Eigen::Index end_flow(int c) const { return rim_flow(rims_.size()) + c; }
  Eigen::Index groove_flow(int c) const { return end_flow(grid_.size()) + c; }
  Eigen::Index flow_count() const { return grooves_ ? groove_flow(grid_.size()) : groove_flow(0); }

  /// What `flows` [m3/s] take out of each cell, n: div q [m/s].
  void leaving(const Eigen::ArrayXd& flows, Eigen::ArrayXd& rate) const;
  /// Sums volumes `moved` [m3], listed as flows, over the edges and ends.
  void add_up_edges(const Eigen::ArrayXd& moved, EdgeVolumes& volumes) const;
  /// Reduces the volumes `sent` [m3], listed as flows, that earlier stages moved, so that no cell
  /// gives more than it held and received, and sets `before` = content - div(sent) / area >= 0 [m],
  /// n.
  void limit_outflow(const Eigen::ArrayXd& content, Eigen::ArrayXd& sent,
                     Eigen::ArrayXd& before) const;

 private:
  void add_faces();
  void add_rims(const Edges& edges);
  void number_cells();
  std::pair<int, int> cells_of(Eigen::Index flow) const;

  PadGrid grid_;
  Edge liner_end_;
  bool grooves_;
  std::vector<Face> faces_;
  std::vector<Rim> rims_;
  std::vector<int> row_;  // by cell
};

}  // namespace clatter::film
