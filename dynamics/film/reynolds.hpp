// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mass-conserving Reynolds equation of one pad.
#include <Eigen/Core>

#include "core/base/matrix.hpp"
#include "dynamics/film/banded_lu.hpp"
#include "dynamics/film/film_split.hpp"
#include "dynamics/film/film_stage.hpp"
#include "dynamics/film/pad_faces.hpp"
#include "dynamics/film/stage_terms.hpp"

namespace clatter::film {

/// JFO film in stage form, conserving mass for any Runge-Kutta tableau:
///
///   (theta + p / B) s - m~ = -kappa div q,   q = -g^3/(12 mu) grad p + theta c U_m,
///   p >= 0,  0 <= theta <= 1,  p (1 - theta) = 0
///
/// (Jakobsson and Floberg 1957, Olsson 1965; p-theta form of Elrod and Adams 1975, with their bulk
/// modulus in the storage only). Cell-centred finite volumes. A face conducts 2 a^2 b^2 / (a + b)
/// instead of g^3 and carries 2 a b / (a + b) instead of c, a and b being its neighbours' values:
/// exact integrals of 1/h^3 and 1/h^2 for a linear film, so that a full 1-D wedge is exact
/// at the centres. theta is upwinded by U_m; with `profile_before` a face carries
/// theta + l (1 - theta) between 0 and 2 theta, l = rise / (1 - theta_before) within -1 and 1,
/// where rise is half of van Leer's limited slope (J. Comput. Phys. 14, 1974) of the fill before:
/// the lift vanishes as the upstream cell fills and as it empties, and the matrix stays an
/// M-matrix. So theta >= 0 for every step size when m~ >= 0 (see OilContent).
///
/// A layer (see Cavity) is carried by its content instead: min(theta max(2 (1 + l) s, c), c) U_m
/// with s and theta of the upstream cell, l = rise / layer of the layer before, c of the face. A
/// uniform layer stays uniform over any gap, and theta >= 0 needs no bound of l.
///
/// Where the liner ends inside the pad the film is that on the covered part of each row of cells, w
/// of its height, and m~ and the content are w m. It ends at the pressure of `Edges::liner_end`
/// there: faces conduct over the distance of the covered parts. What rests on the grid's wall
/// leaves with it as it is uncovered; as it is covered it brings as much as flows in over an edge.
/// Cells outside (w = 0) have the edge's pressure and no content.
///
/// A cell that a groove covers has the pressure and the fill of its reservoir, which takes what its
/// balance lacks; in one that a window covers theta is not bounded and p = 0. A face between such a
/// cell and another has the thickness of the other and half of its width as distance: the edge lies
/// on the face.
///
/// The unknown of a full cell is p (theta = 1), of a cavitated cell theta (p = 0). For a given
/// split into full and cavitated cells, and into faces within and at their bounds, the system is
/// linear, and its matrix is a column-diagonally dominant M-matrix; the split is found by an active
/// set (see SplitSearch), starting from the last one.
class Reynolds {
 public:
  /// `cavitation` false: every cell stays full and p may be negative (full Sommerfeld); m~ must
  /// then be that of full cells.
  /// `reservoirs`: there are grooves.
  Reynolds(const PadGrid& grid, const Edges& edges, bool cavitation, bool reservoirs = false);

  /// Solves; `content_before` is m~ [m], n (not read when steady). Returns the number of linear
  /// solves. Throws NumericsError when no split is found or the matrix is singular.
  int solve(const FilmCells& film, const Eigen::ArrayXd& content_before, const FilmStage& stage);

  /// Pressure [Pa], n.
  const Eigen::ArrayXd& pressure() const { return pressure_; }
  /// Fill theta, n.
  const Eigen::ArrayXd& fill() const { return fill_; }
  /// Oil content of a cell relative to that when just full, theta + p / B; n.
  Eigen::ArrayXd density() const;
  bool is_full(int cell) const { return split_.is_full(cell); }
  /// What the sliding wall carries of a cell, n: theta of streamers, min(theta s, c / 2) [m] of
  /// layers.
  Eigen::ArrayXd profile() const;
  /// Fraction of a cell's area that is sheared between the walls, and its slope by theta: theta for
  /// streamers; 2 theta - 1, not below 0, for layers of at most half of the gap on both walls; less
  /// what is in a recess.
  ValueSlope sheared(int cell) const;
  /// Largest mass residual of a cell relative to the largest terms of its balance.
  double residual() const { return residual_; }
  /// Volume flows as PadFaces lists them [m3/s].
  const Eigen::ArrayXd& flows() const { return flows_; }
  /// The part of flows() that the wall carries over faces and rims; 0 where that is known.
  const Eigen::ArrayXd& carried() const { return carried_; }
  /// Volume that flowed out over the edges and ends in the stage, kappa * sum of q n L [m3] (flow
  /// [m3/s] when steady).
  double outflow() const { return outflow_; }

  /// Exact derivatives of the last solution along the k gap fields `dh` (n x k) [m]: row c of
  /// `derivative` is dp/d(.) for a full cell and dtheta/d(.) for a cavitated one. `height` (k) [m]:
  /// by how much each moves the pad past the ends of the liner; null: none does.
  void sensitivities(const RowMatrix& dh, RowMatrix& derivative,
                     const Eigen::VectorXd* height = nullptr);
  /// The same by the mean wall velocity along the axis [s/m], n; 0 where the wall is at rest.
  void speed_sensitivity(Eigen::ArrayXd& derivative);

  // Of the last solution.
  const FilmExtent& extent() const { return terms_.extent(); }
  const FilmCells& cells() const { return terms_.film(); }

  const PadFaces& pad() const { return terms_.pad(); }
  const PadGrid& grid() const { return terms_.grid(); }
  bool cavitation() const { return cavitation_; }

 private:
  void add(int cell, int unknown, double value);
  void give(int cell, double value);
  void assemble();
  void assemble_cells();
  void assemble_flows();
  void assemble_grooves();
  void assemble_ends();
  void unpack();
  void measure();
  void measure_cell(int cell, double flow_scale);

  bool cavitation_;
  StageTerms terms_;  // of the last solution
  FilmSplit split_;
  BandedLu lu_;
  Eigen::VectorXd x_;  // p / pressure_scale of full cells, theta of others, by rows
  RowMatrix slopes_;   // by rows
  Eigen::ArrayXd pressure_, fill_, flows_, carried_, balance_, magnitude_;
  double residual_ = 0.0, outflow_ = 0.0;
};

}  // namespace clatter::film
