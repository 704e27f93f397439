// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A strip of film along the stroke, with the layer below it remembered on the liner or not.
#include <functional>
#include <optional>

#include "dynamics/film/covered_layer.hpp"
#include "dynamics/film/oil_content.hpp"
#include "dynamics/film/reynolds.hpp"
#include "dynamics/integrate/tableau.hpp"

namespace clatter::film {

/// What slides and what is given, per metre of width.
struct StrokeConditions {
  double begin = 0.0, end = 0.06;            // of the skirt [m]
  double layer = 0.0;                        // on the liner beyond it [m]
  double viscosity = 0.01;                   // [Pa s]
  double bulk_modulus = 2e8;                 // [Pa]
  std::function<double(double time)> speed;  // of the liner past the skirt, along +z [m/s]
  bool remembered = true;  // CoveredLayer; false: content and flux of the cells alone
};

/// The film of PadFilm on one column of cells: Reynolds, OilContent and CoveredLayer under a
/// tableau.
class StrokeMarch {
 public:
  StrokeMarch(int cells, StrokeConditions conditions);
  StrokeMarch(const StrokeMarch&) = delete;
  /// At `time` the liner has the layer `liner(z)` [m] and the skirt `skirt(z)` [m] on it.
  void start(double time, const std::function<double(double)>& liner,
             const std::function<double(double)>& skirt);
  /// A step in a gap that is given over time; returns the load at its end [N/m].
  double step(const dynamics::Tableau& method, double dt,
              const std::function<Eigen::ArrayXd(double)>& gap);
  /// A step of a body of `mass` [kg/m] that `force` [N/m] pushes: the gap is shape - y.
  double step_body(const dynamics::Tableau& method, double dt, const Eigen::ArrayXd& shape,
                   double mass, double force);

  /// `value(z)` at the centres of the cells, n.
  Eigen::ArrayXd at_cells(const std::function<double(double)>& value) const;
  const Eigen::ArrayXd& content() const { return oil_.content(); }
  const Reynolds& film() const { return film_; }
  CoveredLayer* layer() { return covered_ ? &*covered_ : nullptr; }
  /// Oil in the gap and what left it since the start [m2].
  double oil() const;
  double time() const { return time_; }
  /// Derivative of the load by the gap of all cells at once [N/m2], of the last solution.
  double load_by_gap();
  double load() const { return (film_.pressure() * film_.grid().area()).sum(); }
  /// A stage of a step that is not accepted: the load.
  double stage(int index, double kappa, const std::vector<double>& weights, const Eigen::ArrayXd& h,
               double time);

  double y = 0.0, v = 0.0, acceleration = 0.0;  // of the body
  long solves = 0, stages = 0;

 private:
  void finish(int index, double kappa, const std::vector<double>& weights);
  void accept(double dt);
  struct Stages {
    double kappa;
    std::vector<double> weights[3];
    double time[3];
  };
  Stages stages_of(const dynamics::Tableau& method, double dt) const;

  StrokeConditions conditions_;
  Reynolds film_;
  OilContent oil_;
  std::optional<CoveredLayer> covered_;
  FilmCells cells_;
  const KnownFlows* known_ = nullptr;
  double speeds_[3] = {0.0, 0.0, 0.0}, travel_ = 0.0, time_ = 0.0, left_ = 0.0;
  bool running_ = false;
};

}  // namespace clatter::film
