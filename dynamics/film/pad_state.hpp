// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Working memory of one pad of a piston-liner contact; allocated once, only for active effects.
#include <array>
#include <optional>

#include "dynamics/film/piston_liner.hpp"

namespace clatter::film {

/// Oil film of one pad and its content under the integrator's tableau.
struct PadFilm {
  PadFilm(const PadGrid& grid, const Edges& edges, bool cavitation)
      : reynolds(grid, edges, cavitation) {
    cells.resize(grid.size());
    for (Eigen::ArrayXd* values :
         {&content, &fill, &before, &stage_content, &stage_fill, &inverse, &inverse_slope})
      values->setZero(grid.size());
    for (Eigen::ArrayXd& rate : rates) rate.setZero(grid.size());
  }
  Reynolds reynolds;
  FilmCells cells;
  Eigen::ArrayXd content, fill;              // m [m] and theta of the last accepted step
  Eigen::ArrayXd before;                     // m~ of the current stage [m]
  Eigen::ArrayXd stage_content, stage_fill;  // m [m] and theta of the last finished stage
  std::array<Eigen::ArrayXd, 4> rates;       // m' of the stages; [0]: last accepted [m/s]
  int last_stage = 0;
  Eigen::ArrayXd inverse, inverse_slope;  // effective 1/h of the shear
};

struct PistonLiner::Pad {
  Pad(std::string pad_name, PadGrid pad_grid, int n_coordinates)
      : name(std::move(pad_name)), grid(std::move(pad_grid)) {
    const int n = grid.size();
    for (Eigen::ArrayXd* values : {&rest, &gap, &gap_by_height, &load}) values->setZero(n);
    gap_by_y.setZero(n, n_coordinates);
  }
  std::string name;
  PadGrid grid;
  Eigen::ArrayXd rest;           // clearance and skirt relief [m]
  Eigen::ArrayXd gap;            // h [m]
  Eigen::ArrayXd gap_by_height;  // dh/dz along the stroke [1]
  Eigen::ArrayXd load;           // cell area times (p + p_c) [N]
  RowMatrix gap_by_y;            // dh/dy, n x n_e
  RowMatrix derivative;          // dx/dy of the film, then d(load)/dy
  std::optional<PatchMap> liner_map;
  std::optional<LinerShapeMap> liner_shape;
  RowMatrix liner_weights, liner_slopes;  // G_l and dG_l/dz
  std::optional<PadFilm> film;
  Eigen::ArrayXd contact, contact_slope, contact_energy;  // p_c [Pa], dp_c/dh, energy [J/m2]
  Eigen::ArrayXd contact_rate_slope, contact_loss;        // dp_c/dh' [Pa s/m], loss [W/m2]; damped
  RowMatrix rate_by_y;                                    // dh'/dy, n x n_e; damped
  std::optional<Friction> friction;
  Eigen::Matrix<double, Eigen::Dynamic, 3>
      levers;  // friction on pin z, rx, ry per unit axial force, n x 3
};

}  // namespace clatter::film
