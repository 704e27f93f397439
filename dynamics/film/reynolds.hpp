// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mass-conserving Reynolds equation of one pad.
#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/matrix.hpp"
#include "dynamics/film/banded_lu.hpp"
#include "dynamics/film/cover.hpp"
#include "dynamics/film/edge_volumes.hpp"
#include "dynamics/film/flow_factors.hpp"
#include "dynamics/film/grid.hpp"
#include "dynamics/film/recess.hpp"
#include "dynamics/film/split_search.hpp"

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

/// Where the oil of a cell is that it does not fill, and how the sliding wall carries it. One wall
/// rests on the grid, the other slides past it at 2 U_m.
///
///   kStriated  streamers across the gap, which move at U_m like a full film (Jakobsson and Floberg
///              1957): flux theta c U_m
///   kLayer     a layer on the sliding wall, which moves with it, up to half of the gap, and the
///              rest on the wall of the grid: flux min(2 theta s, c) U_m
///
/// Both agree for a full film and wherever the flux is given, as behind a rupture in steady flow; a
/// layer of thickness t has the flux 2 t U_m with the content t in the second, 2 t in the first.
enum class Cavity { kStriated, kLayer };

/// Thicknesses of the film cell by cell and their derivatives by the gap h; n each.
///
/// With smooth surfaces all of them equal h; rough ones: see flow_factors.hpp.
struct FilmCells {
  Eigen::ArrayXd content, d_content;        // volume per area s(h) [m]
  Eigen::ArrayXd flow_angle, d_flow_angle;  // g with g^3 = phi_x h^3, along the circumference [m]
  Eigen::ArrayXd flow_axial, d_flow_axial;  // the same along the axis [m]
  Eigen::ArrayXd carry, d_carry;            // c, thickness carried by the mean wall velocity [m]

  void resize(int n);
  /// Smooth surfaces: every thickness is `h`.
  void set_smooth(const Eigen::ArrayXd& h);
};

/// Data of one implicit stage that do not depend on the cell.
struct FilmStage {
  double kappa = 1.0;      // dt * a_ii [s]
  double viscosity = 0.0;  // [Pa s]
  double speed_angle =
      0.0;  // mean wall velocity relative to the grid, along the circumference [m/s]
  double speed_axial = 0.0;  // the same along the axis [m/s]
  bool steady = false;  // true: div q = 0, no storage; kappa and the content before are not used
  /// Bulk modulus of the oil [Pa]: a full cell holds (1 + p / B) s. 0: incompressible. A body of
  /// mass m per area stops on a cell that fills within sqrt(m s / B) instead of instantly.
  double bulk_modulus = 0.0;
  /// Reynolds::profile() at the start of the step, n: where it varies, a face carries a limited
  /// linear profile instead of the upstream value, second order in the cell size. Null: first
  /// order.
  const Eigen::ArrayXd* profile_before = nullptr;
  /// Striated when steady: then the content of a layer does not follow from its flux.
  Cavity cavity = Cavity::kStriated;
  /// Part of the pad inside the liner, which slides with its ends at 2 U_m along the axis. Null:
  /// all of it. Not when steady.
  const Cover* cover = nullptr;
  /// Grooves and windows (recess.hpp); null: none. Windows not when steady and not without
  /// cavitation.
  const RecessCells* recesses = nullptr;
};

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
  bool is_full(int cell) const { return full_[cell] != 0; }
  /// What the sliding wall carries of a cell, n: theta of streamers, min(theta s, c / 2) [m] of
  /// layers.
  Eigen::ArrayXd profile() const;
  /// Fraction of a cell's area that is sheared between the walls, and its slope by theta: theta for
  /// streamers; 2 theta - 1, not below 0, for layers of at most half of the gap on both walls; less
  /// what is in a recess.
  ValueSlope sheared(int cell) const;
  /// Largest mass residual of a cell relative to the largest terms of its balance.
  double residual() const { return residual_; }
  /// Volume flow over each face (from its first cell to its second), then over each open edge
  /// (outward), out of each cell over the end of the liner, and where there are grooves out of each
  /// cell into them [m3/s].
  const Eigen::ArrayXd& flows() const { return flows_; }
  /// Reduces the volumes `sent` [m3] (as `flows`) that earlier stages moved, so that no cell gives
  /// more than it held and received, and sets `before` = content - div(sent) / area >= 0 [m], n.
  void limit_outflow(const Eigen::ArrayXd& content, Eigen::ArrayXd& sent,
                     Eigen::ArrayXd& before) const;
  /// Volume that flowed out over the edges and ends in the stage, kappa * sum of q n L [m3] (flow
  /// [m3/s] when steady).
  double outflow() const { return outflow_; }

  /// Layers on the sliding wall beyond the first and the last axial edge, by column [m], n_angle
  /// each, instead of those of the edges; for the solutions that follow.
  void set_outside_layers(const Eigen::ArrayXd& begin, const Eigen::ArrayXd& end);
  /// What flows that are listed as `flows` take out of each cell, n: div q [m/s].
  void leaving(const Eigen::ArrayXd& flows, Eigen::ArrayXd& rate) const;
  /// Sums volumes that are listed as `flows` over the edges and ends [m3].
  void add_up_edges(const Eigen::ArrayXd& moved, EdgeVolumes& volumes) const;

  /// Exact derivatives of the last solution along the k gap fields `dh` (n x k) [m]: row c of
  /// `derivative` is dp/d(.) for a full cell and dtheta/d(.) for a cavitated one. `height` (k) [m]:
  /// by how much each moves the pad past the ends of the liner; null: none does.
  void sensitivities(const RowMatrix& dh, RowMatrix& derivative,
                     const Eigen::VectorXd* height = nullptr);
  /// The same by the mean wall velocity along the axis [s/m], n; 0 where the wall reverses.
  void speed_sensitivity(Eigen::ArrayXd& derivative);

  const PadGrid& grid() const { return grid_; }
  bool cavitation() const { return cavitation_; }

 private:
  struct Face {
    int a, b;         // cells; flow counts from a to b
    double length;    // [m]
    double distance;  // between the centres [m]
    bool axial;
    int beyond_a, beyond_b;  // the next cells along the same line; -1: none
  };
  struct Rim {
    int cell;
    double length, distance;  // distance from the centre to the edge [m]
    double sign;              // outward direction along the axis of flow
    bool axial;
    Edge edge;
  };
  struct FaceFill {
    double empty, full;  // theta on the face for an empty and for a full upstream cell
  };
  /// The part of a face or open edge inside the liner, and its derivatives by the pad's height.
  struct Inside {
    double distance, distance_slope = 0.0;      // [m]
    double length = 1.0, length_slope = 0.0;    // factor of the length
    double carried = 1.0, carried_slope = 0.0;  // of the length over which the liner carries
    double outer = 1.0, outer_slope = 0.0;      // cover of the less covered cell over that of
    bool outer_is_b = true;                     // the other
    /// `values` of both cells at the centres of their covered parts.
    std::pair<double, double> beside(double a, double b) const;
    /// From derivatives by the values at those centres to derivatives by `values`.
    void to_cells(double& by_a, double& by_b) const;
  };
  Inside inside(const Face& face) const;
  Inside covered_part(const Face& face) const;
  Inside inside(const Rim& rim) const;
  /// What a cell is in a stage.
  enum class CellKind : char {
    kFilm,
    kBesideGroove,  // film, part of which a groove covers
    kGroove,        // pressure and fill are those of its reservoir
    kWindow,        // without pressure, its fill is not bounded
    kOutside,       // of the liner: it has the pressure of the edge
  };
  CellKind kind_of(int cell) const;
  bool is(CellKind kind, int cell) const { return kind_[cell] == kind; }
  bool in_recess(int cell) const {
    return is(CellKind::kGroove, cell) || is(CellKind::kWindow, cell);
  }
  /// The pressure or the fill of the cell is given.
  bool is_given(int cell) const {
    return is(CellKind::kGroove, cell) || is(CellKind::kOutside, cell);
  }
  /// The liner carries all of its oil across a window.
  bool within_window(size_t face) const {
    return is(CellKind::kWindow, faces_[face].a) && is(CellKind::kWindow, faces_[face].b);
  }
  int content_cell(size_t face) const;
  void edge_of_recess(const Face& face, Inside& in) const;
  void guess_recesses();
  void weigh_reservoirs(double mobility);
  void add_reservoirs(double mobility, const RowMatrix& dh);
  void weigh_ends();
  FaceFill end_law(int cell) const;
  double end_thickness(int cell) const;
  double end_thickness_slope(int cell) const;
  Eigen::ArrayXd height_slopes() const;
  void build_faces();
  void number_cells();
  int upstream_of(size_t face) const {
    return carry_[face] > 0.0 ? faces_[face].a : faces_[face].b;
  }
  double lift(const Face& face, double speed) const;
  double lowest_lifted(size_t face) const;
  bool layers() const { return stage_.cavity == Cavity::kLayer && !stage_.steady; }
  /// Whether the flux over a face follows the content of its upstream cell instead of c.
  bool carries_content(size_t face) const {
    return layers() && !is_full(upstream_of(face)) && limited_[face] == 0 && ratio_[face] > 1.0;
  }
  bool violates_limit(size_t face, double theta) const;
  ValueSlope entering(const Edge& edge, int cell) const;
  FaceFill face_fill(size_t face) const;
  double fill_on_face(size_t face) const;
  double fill_on_rim(size_t rim) const;
  void weigh(const FilmCells& film, const Eigen::ArrayXd& content_before, const FilmStage& stage);
  void assemble();
  void guess_split();
  bool update_split();
  void unpack();
  void measure();

  PadGrid grid_;
  Edges edges_;
  bool cavitation_, reservoirs_;
  std::vector<Face> faces_;
  std::vector<Rim> rims_;
  std::vector<int> row_;  // cell -> row of the banded system
  BandedLu lu_;
  std::vector<char> full_;         // by cell
  std::vector<char> limited_;      // by face: the lift is at its bound, or the layer at c
  std::vector<char> rim_limited_;  // by open edge: the layer is at c
  std::vector<char> end_limited_;  // the same by cell, where the liner ends
  bool partial_ = false;           // part of the pad is outside the liner
  std::vector<CellKind> kind_;     // by cell
  SplitSearch search_;
  std::vector<int> violated_;
  bool started_ = false;

  // Nondimensional terms of the current stage: storage s, storage by pressure s / B, m~,
  // conductance, carried volume and lift of faces, the same of rims.
  Eigen::ArrayXd storage_, squeeze_, before_;
  std::vector<double> conduct_, carry_, lift_, rim_conduct_, rim_carry_, rim_entering_;
  Eigen::ArrayXd exchange_;  // conductance to the groove beside, n; empty: no grooves
  Eigen::ArrayXd covered_;   // volume per thickness that the stage covers at the end, by cell [1/m]
  std::vector<double> ratio_, rim_ratio_;  // of layers, 2 (1 + l) s / c, on faces and open edges
  double volume_scale_ = 1.0, pressure_scale_ = 1.0;
  FilmCells film_;  // of the last solve
  FilmStage stage_;
  Eigen::VectorXd x_;
  RowMatrix work_;
  Eigen::ArrayXd pressure_, fill_, flows_, scratch_, magnitude_;
  double residual_ = 0.0, outflow_ = 0.0;
};

}  // namespace clatter::film
