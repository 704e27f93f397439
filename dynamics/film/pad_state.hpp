// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Working memory of one pad of a piston-liner contact; allocated once, only for active effects.
#include <optional>

#include "dynamics/film/gap_map.hpp"
#include "dynamics/film/liner_layer.hpp"
#include "dynamics/film/oil_content.hpp"
#include "dynamics/film/piston_liner.hpp"

namespace clatter::film {

/// Oil film of one pad.
struct PadFilm {
  PadFilm(const PadGrid& grid, const Edges& edges, const PistonLinerOptions& options)
      : reynolds(grid, edges, options.effects.cavitation, has_grooves(options)),
        oil(reynolds, options.liner_layer.has_value()) {
    cells.resize(grid.size());
    for (Eigen::ArrayXd* values : {&shear.inverse, &shear.inverse_slope})
      values->setZero(grid.size());
  }
  Reynolds reynolds;
  FilmCells cells;
  OilContent oil;
  ShearThickness shear;
  Eigen::ArrayXd viscosity_ratio, viscosity_ratio_slope;  // over the reference; empty: constant
  Eigen::ArrayXd thick_pressure, thickening;  // p [Pa] and exp(alpha p); empty: p is reynolds'

  const Eigen::ArrayXd& pressure() const {
    return thickening.size() > 0 ? thick_pressure : reynolds.pressure();
  }
};

/// What a pad knows of the oil beyond its edges.
struct PadLayer {
  PadLayer(const LinerLayerOptions& options, const PadGrid& grid) : layer(options, grid) {}
  LinerLayer layer;
  Eigen::ArrayXd lower, upper;  // thickness that its edges meet [m], n_angle
  Eigen::ArrayXd moved;         // Reynolds::flows() times time of the last stage [m3]
  EdgeVolumes volumes;
  double first = 0.0;  // oil of pad and liner at the start [m3]
  OilBalance balance;  // of the last accepted step
};

/// Grooves and windows of a pad.
struct PadRecesses {
  RecessMap map;
  bool moves;  // some are on the liner
  RecessCells cells;
  double moved = 0.0,
         moved_sum = 0.0;  // volume into grooves since the start [m3], and without sign
};

struct PistonLiner::Pad {
  Pad(std::string pad_name, PadGrid pad_grid, GapMap gap_map)
      : name(std::move(pad_name)), grid(std::move(pad_grid)), map(std::move(gap_map)) {
    const int n = grid.size();
    for (Eigen::ArrayXd* values : {&rest, &gap, &gap_by_height, &load}) values->setZero(n);
    area = grid.area();
    area_slope.setZero(n);
  }
  bool in_recess(Eigen::Index cell) const { return recesses && recesses->cells.covered(cell); }
  /// Inside the liner and not in a recess, n.
  Eigen::Array<bool, Eigen::Dynamic, 1> carrying() const;
  std::string place() const { return grid.periodic() ? name : name + " pad"; }
  std::string name;
  PadGrid grid;
  GapMap map;                    // k columns
  Eigen::ArrayXd rest;           // clearance and skirt relief [m]
  Eigen::ArrayXd gap;            // h [m]
  Eigen::ArrayXd gap_by_height;  // dh/dz along the stroke [1]
  Eigen::ArrayXd load;           // covered area times (p + p_c) [N]
  std::optional<CoverMap> ends;  // of the liner; none: it covers the pad everywhere
  Cover cover;
  Eigen::ArrayXd area, area_slope;  // covered area of the cells [m2], its derivative by height [m]
  SparseRows gap_by_y;              // dh/dy, n x k
  SparseRows rate_by_y;             // dh'/dy, n x k; damped
  Eigen::VectorXd v;                // of the columns, k
  Eigen::VectorXd force;            // on the columns, k
  RowMatrix tangent;                // of the force, k x k
  Eigen::VectorXd force_by_turn;    // of the force by the rotation of a free crank, k
  Eigen::Vector3d rub_by_turn;      // of the wrench of friction
  RowMatrix gap_directions;         // dh/dy for the film, n x k
  RowMatrix derivative;             // dx/dy of the film, then d(load)/dy, n x k
  std::vector<LinerShapeMap> liner_shapes;
  std::optional<ScaledGap> scaled;
  std::optional<PadRecesses> recesses;
  std::optional<PadFilm> film;
  std::optional<PadLayer> layer;
  Eigen::ArrayXd contact, contact_slope, contact_energy;  // p_c [Pa], dp_c/dh, energy [J/m2]
  Eigen::ArrayXd contact_elastic;                         // p_a [Pa]
  Eigen::ArrayXd contact_rate_slope, contact_loss;        // dp_c/dh' [Pa s/m], loss [W/m2]; damped
  std::optional<Friction> friction;
  Eigen::Matrix<double, Eigen::Dynamic, 3>
      levers;  // (F, M_x, M_y) about the pin's centre per unit axial force, n x 3
  long film_solves = 0;
};

}  // namespace clatter::film
