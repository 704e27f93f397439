// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil film of a full journal bearing on a grid.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/bearing/bearing_film.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/film/oil_content.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::dynamics {

/// A bearing and its grid.
struct JournalFilmOptions {
  BearingSize size;
  int cells_around = 72;
  int cells_along = 6;           // of half of the width
  double groove = 0.0;           // angle of the supply groove from +z about +x [rad]
  double supply_pressure = 3e5;  // of the oil in it, over that at the ends [Pa]
  double bulk_modulus = 1e9;     // of the oil [Pa]; 0: incompressible
  bool cavitation = true;        // off: every cell is full, and pressure may be negative
};

/// Reynolds' equation with mass-conserving cavitation (film/reynolds.hpp) on the developed bearing,
/// in whose axes the grid rests; the journal slides past it at R spin:
///
///   h = c - e . n(phi),   F = - integral p n dA,
///   M = - integral eta R^2 spin a / h dA - (e x F) / 2
///
/// e is the offset of the journal, n the direction at the angle phi, a the sheared fraction. The
/// second part of M is that of Poiseuille's flow, as in BearingFilm. The journal is parallel to the
/// bearing, so half of the width is solved. Oil enters from a narrow groove along the axis, which
/// is always full; the pressure at the ends is that of cavitation, where oil leaves and none
/// enters. At the start the bearing is full. The content follows the integrator's tableau.
class JournalFilm {
 public:
  explicit JournalFilm(const JournalFilmOptions& options);

  /// At a stage. Derivatives by the offset are those at a fixed stage, with the squeeze; those by
  /// the velocity are 0, those by the spin are of Couette's part of the moment only. StepRefused
  /// where the journal touches the bearing or the film is not solved.
  FilmForce force(const JournalMotion& motion, const Stage& stage, bool with_derivatives);
  void begin_step() { oil_.begin_step(); }
  /// Keeps the last solution as that of the stage.
  void finish_stage(const Stage& stage);
  void accept_step();
  std::vector<double> save() const;
  /// InputError for a state of another grid.
  void restore(const std::vector<double>& state);

  const JournalFilmOptions& options() const { return options_; }
  const film::Reynolds& film() const { return reynolds_; }
  /// Area of both halves of the bearing that a cell stands for [m2], n.
  const Eigen::ArrayXd& area() const { return area_; }

 private:
  void set_gap(const Eigen::Vector2d& offset);
  JournalFilmOptions options_;
  film::Reynolds reynolds_;
  film::OilContent oil_;
  film::FilmCells cells_;
  Eigen::MatrixX2d normal_;  // n(phi), n x 2
  Eigen::ArrayXd area_, gap_;
  RowMatrix directions_, derivative_;  // of the gap, of the film, n x 2
  bool running_ = false;               // false: the content is that of the start
};

}  // namespace clatter::dynamics
