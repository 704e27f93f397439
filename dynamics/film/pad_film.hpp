// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil film of one pad: pressure, content under the tableau, and the layer that supplies it.
#include <optional>
#include <string>
#include <vector>

#include "dynamics/film/covered_layer.hpp"
#include "dynamics/film/oil_content.hpp"
#include "dynamics/film/pad_gap.hpp"
#include "dynamics/film/pad_layer.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// The film in the gap of a pad, between rough walls, of an oil of given viscosity.
class PadFilm {
 public:
  /// `model` has a film, and is read while this is used. `place`: of the pad, for messages.
  PadFilm(const ContactModel& model, const PadGrid& grid, std::string place);

  /// The content at the start of the run, from the gap at this state. InputError when the gap is
  /// below the film's minimum.
  void start(const PadGap& gap, const PadState& state);
  /// The film of a stage; `first_step`: the content is still the initial one. Throws StepRefused.
  void solve(const PadGap& gap, const PadState& state, bool first_step);

  const Eigen::ArrayXd& pressure() const {  // p [Pa], n
    return thickening_.size() > 0 ? thick_pressure_ : reynolds_.pressure();
  }
  bool is_full(int cell) const { return reynolds_.is_full(cell); }
  const Reynolds& reynolds() const { return reynolds_; }
  const FilmCells& cells() const { return cells_; }
  /// None unless it is remembered.
  const std::optional<PadLayer>& layer() const { return layer_; }
  /// Linear solves so far.
  long solves() const { return solves_; }

  /// dp/d(.) of full cells, dtheta/d(.) of others, along the gap's directions, n x k.
  void sensitivities(const PadGap& gap, RowMatrix& derivative);
  /// The same by the speed U of the skirt past the liner, n [s/m].
  void speed_sensitivity(Eigen::ArrayXd& derivative);
  /// Adds the shear of the last solution at the stroke's velocity [m/s].
  void add_friction(const PadGap& gap, double velocity, Friction& friction);

  void begin_step() { oil_.begin_step(); }
  void finish_stage(const dynamics::Stage& stage);
  /// A step of `dt` [s] in which the pad moved by `travel` [m]; `left` [m]: what the rings leave.
  void accept_step(double dt, double travel, const std::vector<double>& left);

  void save(std::vector<double>& state) const;
  size_t saved_size() const;
  std::vector<double>::const_iterator restore(std::vector<double>::const_iterator next);

 private:
  [[noreturn]] void refuse_gap(const PadGap& gap, double lowest) const;
  void solve_equations(const PadState& state, const FilmStage& stage);
  double in_gap() const { return (oil_.content() * reynolds_.grid().area()).sum(); }

  const PistonLinerOptions& options_;
  const RoughFilm& rough_;
  const Viscosity& viscosity_;
  std::string place_;
  Reynolds reynolds_;
  FilmCells cells_;
  OilContent oil_;
  std::optional<CoveredLayer> covered_;  // of layers
  const KnownFlows* known_ = nullptr;    // of the last stage
  std::optional<PadLayer> layer_;
  ShearThickness shear_;
  Eigen::ArrayXd viscosity_ratio_, viscosity_ratio_slope_;  // over the reference; empty: constant
  Eigen::ArrayXd thick_pressure_, thickening_;  // p [Pa] and exp(alpha p); empty: p is reynolds_'
  RowMatrix directions_;                        // dh/dy, n x k
  long solves_ = 0;
};

}  // namespace clatter::film
