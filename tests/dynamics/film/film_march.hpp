// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Helpers of the film tests: one-dimensional strips, marching in time, a rigid body thrown at a
// wall.
#include <functional>

#include "dynamics/film/oil_content.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "dynamics/film/reynolds.hpp"
#include "dynamics/integrate/tableau.hpp"

namespace clatter::film {

/// A strip of `cells` cells along the axis over [begin, end] [m], 1 m wide, walls on both long
/// sides.
PadGrid strip(double begin, double end, int cells);
/// Walls along the strip, `first` and `last` at its ends.
Edges strip_edges(const Edge& first = {}, const Edge& last = {});
/// Gap at the cell centres of a strip.
Eigen::ArrayXd along(const PadGrid& grid, const std::function<double(double)>& gap);
FilmCells smooth(const Eigen::ArrayXd& h);
/// Sum of p times area [N].
double load(const Reynolds& film);

/// A gap given over time: h [m] of all cells and its rate [m/s], n each.
struct GivenGap {
  std::function<Eigen::ArrayXd(double)> at, rate;
};

/// Integrates the film in a given gap by the integrator's tableau. Within a step the gap follows
/// the tableau, from its value at the start of the step, as in PistonLiner.
class FilmMarch {
 public:
  /// `conditions`: viscosity, speeds, bulk modulus. At `begin` the gap holds `fill` of its volume,
  /// n.
  FilmMarch(Reynolds& film, GivenGap gap, const FilmStage& conditions, double begin,
            const Eigen::ArrayXd& fill);
  void implicit_euler(double dt);
  void step(const dynamics::Tableau& method, double dt);
  double time() const { return time_; }
  const OilContent& oil() const { return oil_; }

 private:
  void stage(int index, const Eigen::ArrayXd& h, double kappa, const std::vector<double>& weights);
  Reynolds& film_;
  GivenGap gap_;
  FilmStage conditions_;
  double time_;
  bool running_ = false;
  FilmCells cells_;
  OilContent oil_;
};

/// Observed order between successive halvings.
double order(double coarse_error, double fine_error);

/// A body of six coordinates with only this element: TR-BDF2 with full Newton, halved steps when
/// refused.
class Flight {
 public:
  Flight(dynamics::ForceElement& element, Eigen::VectorXd mass, Eigen::VectorXd y,
         Eigen::VectorXd v);
  /// Advances by at most `dt`; true when accepted.
  bool step(double dt);
  /// Takes back the motion of an earlier copy (the element's own state is the caller's to restore).
  void restore(const Flight& earlier);
  /// Implicit Euler over a vanishing step: settles the element's internal rates.
  void start();

  Eigen::VectorXd mass, y, v, force;
  double time = 0.0;
  int refused = 0;

 private:
  bool solve_stage(const dynamics::Stage& stage, const Eigen::VectorXd& y_before,
                   const Eigen::VectorXd& v_before, Eigen::VectorXd& y_new, Eigen::VectorXd& a_new);
  dynamics::ForceElement& element_;
  Eigen::VectorXd a_;
  dynamics::Response response_;
};

}  // namespace clatter::film
