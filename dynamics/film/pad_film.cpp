// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/pad_film.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

Edges open_edges(const ContactModel& model) {
  const PistonLinerOptions& options = model.options;
  const Edge open = Edge::supply(model.viscosity->reduced(options.supply_pressure),
                                 options.supply_fill, options.oil_thickness);
  return {open, open, open, open, open};
}

}  // namespace

PadFilm::PadFilm(const ContactModel& model, const PadGrid& grid, std::string place)
    : options_(model.options),
      rough_(*model.rough),
      viscosity_(*model.viscosity),
      place_(std::move(place)),
      reynolds_(grid, open_edges(model), options_.effects.cavitation,
                has_grooves(options_.recesses)),
      oil_(reynolds_) {
  if (options_.effects.cavitation && options_.cavity == Cavity::kLayer)
    covered_.emplace(reynolds_.pad());
  cells_.resize(grid.size());
  if (options_.liner_layer) layer_.emplace(*options_.liner_layer, reynolds_);
  for (Eigen::ArrayXd* values : {&shear_.inverse, &shear_.inverse_slope})
    values->setZero(grid.size());
}

// The gap filled by the scene's fraction, or the layer on the liner. Streamers need twice the layer
// to carry its flux.
void PadFilm::start(const PadGap& gap, const PadState& state) {
  const double lowest = gap.lowest();
  if (lowest <= rough_.lowest_gap())
    throw InputError(fmt::format(
        "{}: found a smallest gap of {:.3g} m at the start, expected more than {:.3g} m",
        options_.name, lowest, rough_.lowest_gap()));
  rough_.thicknesses(gap.value(), cells_);
  const double layers = options_.cavity == Cavity::kLayer ? 1.0 : 2.0;
  oil_.start((options_.initial_fill * cells_.content).min(layers * options_.oil_thickness) *
             gap.area() / gap.grid().area());
  if (covered_) covered_->start(oil_.content().min(0.5 * cells_.carry));
  if (layer_) layer_->start(state.pin.ideal.position, options_.oil_thickness, in_gap());
}

void PadFilm::solve(const PadGap& gap, const PadState& state, bool first_step) {
  const double lowest = gap.lowest(), speed = state.pin.ideal.velocity;
  if (lowest <= rough_.lowest_gap()) refuse_gap(gap, lowest);
  rough_.thicknesses(gap.value(), cells_);
  if (viscosity_.varies()) {
    viscosity_.ratio(gap.grid(), state.pin.ideal.position, speed, cells_, viscosity_ratio_,
                     viscosity_ratio_slope_);
    divide_conductance(viscosity_ratio_, viscosity_ratio_slope_, cells_);
  }
  // The liner slides past the grid at -U: the mean wall velocity is half of that.
  FilmStage stage{state.stage.kappa,    options_.viscosity, 0.0, -0.5 * speed, false,
                  options_.bulk_modulus};
  if (!first_step) stage.profile_before = &oil_.profile();
  stage.cavity = options_.cavity;
  stage.cover = gap.cover();
  stage.recesses = gap.recesses();
  if (layer_) stage.outside = &layer_->meet(state.travel);
  if (covered_) stage.known = known_ = &covered_->slide(state.travel, cells_, stage);
  solve_equations(state, stage);
}

void PadFilm::refuse_gap(const PadGap& gap, double lowest) const {
  const auto carrying = gap.carrying();
  const PadGrid& grid = gap.grid();
  int cell = 0;
  while (!(carrying[cell] && gap.value()[cell] == lowest)) ++cell;
  throw dynamics::StepRefused(
      options_.name + ": gap below the film's minimum",
      fmt::format("{:.3g} m on the {} at {:.1f} deg, {:.1f} mm from the pin", lowest, place_,
                  grid.angle(cell / grid.n_axial()) * 180.0 / std::numbers::pi,
                  1e3 * grid.axial(cell % grid.n_axial())));
}

void PadFilm::solve_equations(const PadState& state, const FilmStage& stage) {
  try {
    solves_ += reynolds_.solve(cells_, oil_.before(reynolds_, state.stage.weights, known_), stage);
  } catch (const NumericsError& error) {
    throw dynamics::StepRefused(options_.name + ": the film's equations were not solved",
                                fmt::format("{}: {}", place_, error.what()));
  }
  if (viscosity_.pressure_coefficient() > 0.0 &&
      !viscosity_.pressure(reynolds_.pressure(), thick_pressure_, thickening_))
    throw dynamics::StepRefused(
        options_.name + ": no film pressure carries the load",
        fmt::format("{}: {:.3g} Pa reduced pressure", place_, reynolds_.pressure().maxCoeff()));
}

void PadFilm::sensitivities(const PadGap& gap, RowMatrix& derivative) {
  directions_ = gap.by_y();
  reynolds_.sensitivities(directions_, derivative, &gap.map().height_by_column());
  for (Eigen::Index c = 0; c < thickening_.size(); ++c)  // dp/dP of full cells
    if (is_full(static_cast<int>(c))) derivative.row(c) *= thickening_[c];
}

void PadFilm::speed_sensitivity(Eigen::ArrayXd& derivative) {
  reynolds_.speed_sensitivity(derivative);
  derivative *= -0.5;  // the mean wall velocity is -U / 2
  for (Eigen::Index c = 0; c < thickening_.size(); ++c)
    if (is_full(static_cast<int>(c))) derivative[c] *= thickening_[c];
}

void PadFilm::add_friction(const PadGap& gap, double velocity, Friction& friction) {
  rough_.shear(gap.value(), cells_, shear_);
  if (viscosity_.varies())
    multiply_shear(viscosity_ratio_, viscosity_ratio_slope_, shear_.inverse, shear_.inverse_slope);
  FilmPressure at{pressure()};
  if (thickening_.size() > 0) {
    at.thickening = &thickening_;
    at.coefficient = viscosity_.pressure_coefficient();
  }
  friction.add_film(reynolds_, at, shear_, options_.viscosity, velocity);
}

void PadFilm::finish_stage(const dynamics::Stage& stage) {
  oil_.finish_stage(reynolds_, stage.index, stage.kappa, stage.weights, known_);
}

void PadFilm::accept_step(double dt, double travel, const std::vector<double>& left) {
  oil_.accept_step();
  if (covered_) covered_->advance(travel, reynolds_, oil_, oil_.content());
  if (layer_) layer_->advance(reynolds_.pad(), dt, travel, oil_.moved(), left, in_gap());
}

void PadFilm::save(std::vector<double>& state) const {
  oil_.save(state);
  if (covered_) covered_->save(state);
  if (layer_) layer_->save(state);
}

size_t PadFilm::saved_size() const {
  return oil_.saved_size() + (covered_ ? covered_->saved_size() : 0) +
         (layer_ ? layer_->saved_size() : 0);
}

std::vector<double>::const_iterator PadFilm::restore(std::vector<double>::const_iterator next) {
  next = oil_.restore(next);
  if (covered_) next = covered_->restore(next, oil_.profile());
  if (layer_) next = layer_->restore(next, in_gap());
  return next;
}

}  // namespace clatter::film
