// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/piston_liner.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {
namespace {

void require(bool holds, const std::string& name, const char* key, double found,
             const char* expected) {
  if (!holds)
    throw InputError(fmt::format("{}: {}: found {}, expected {}", name, key, found, expected));
}

// Cells around the entire skirt: fewer do not resolve a gap that varies with its sine. An odd
// number is not symmetric about the thrust plane.
constexpr int kLeastAround = 8;

/// The entire skirt begins and ends at the pin, where the film is closed.
PadGrid make_grid(const PistonLinerOptions& options, double centre) {
  if (options.span == SkirtSpan::kWhole)
    return PadGrid::uniform(-0.5 * std::numbers::pi, 1.5 * std::numbers::pi, options.cells_around,
                            options.skirt_bottom, options.skirt_top, options.cells_along,
                            options.bore_radius, true);
  return PadGrid::uniform(centre - 0.5 * options.pad_span, centre + 0.5 * options.pad_span,
                          options.cells_around, options.skirt_bottom, options.skirt_top,
                          options.cells_along, options.bore_radius);
}

}  // namespace

PistonLiner::~PistonLiner() = default;

PistonLiner::PistonLiner(PistonLinerOptions options, PistonLinerBodies bodies,
                         std::vector<int> coordinates)
    : ForceElement(std::move(coordinates)),
      options_(std::move(options)),
      bodies_(std::move(bodies)) {
  check();
  const ContactEffects& on = options_.effects;
  if (!on.cavitation) {  // every cell is full: no setting of partial filling applies
    options_.initial_fill = options_.supply_fill = 1.0;
    options_.oil_thickness = std::numeric_limits<double>::infinity();
    for (Recess& recess : options_.recesses) {
      recess.kind = Recess::Kind::kGroove;
      recess.fill = 1.0;
    }
  }
  if (on.film) {
    rough_ = std::make_unique<RoughFilm>(options_.roughness);
    viscosity_ = std::make_unique<Viscosity>(options_.oil, options_.viscosity);
    options_.viscosity = viscosity_->reference();
  } else {
    options_.liner_layer.reset();
  }
  if (on.asperities) asperity_ = std::make_unique<Asperity>(options_.asperity);
  if (on.asperities && options_.damping.loss_factor > 0.0)
    damping_ = std::make_unique<ContactDamping>(options_.damping);
  const auto patches_of = [](const std::optional<ElasticSurface>& surface) {
    return surface ? static_cast<int>(surface->grid.angle.size() * surface->grid.axial.size()) : 0;
  };
  at_ = {patches_of(bodies_.piston), patches_of(bodies_.liner)};
  if (static_cast<int>(coordinates_.size()) != size())
    throw InputError(fmt::format("{}: found {} coordinates, expected {}", options_.name,
                                 coordinates_.size(), size()));
  bodies_.crank.join(coordinates_);
  touched_row_.assign(coordinates_.size(), -1);
  const auto n = static_cast<int>(coordinates_.size());
  if (bodies_.liner) {
    find_ends(bodies_.liner->grid);
    const LinerAxial liner{at_.axial(), at_.liner_fit() + 2};
    axial_ = axial_motion(n, at_.pin(), bodies_.liner_axial, &liner);
  } else {
    axial_ = axial_motion(n, at_.pin(), bodies_.bore_axis, nullptr);
  }
  if (options_.liner_layer) {
    LinerLayerOptions& layer = *options_.liner_layer;
    layer.bottom = std::max(layer.bottom, options_.ends.bottom);
    layer.top = std::min(layer.top, options_.ends.top);
  }
  if (options_.warm_clearance)
    options_.clearance =
        options_.warm_clearance->minimum - nearest_point(options_, *options_.warm_clearance).gap;
  height_by_y_.setZero(size());
  for (const auto& [coordinate, factor] : axial_.height) height_by_y_[coordinate] += factor;
  for (const auto* shapes : {&options_.scaled_bore, &options_.scaled_skirt})
    for (const ScaledShape& shape : *shapes) scales_.add(shape.scale);
  if (options_.span == SkirtSpan::kWhole) {
    add_pad("skirt", 0.0);
  } else {
    add_pad("thrust", 0.0);
    add_pad("antithrust", std::numbers::pi);
  }
  check_recesses();
}

void PistonLiner::add_pad(const char* name, double centre) {
  const ContactEffects& on = options_.effects;
  const PadGrid grid = make_grid(options_, centre);
  pads_.push_back(std::make_unique<Pad>(name, grid, GapMap(bodies_, at_, grid, height_by_y_)));
  Pad& pad = *pads_.back();
  pad.rest = options_.clearance + skirt_relief(options_.skirt, grid);
  Eigen::ArrayXd slope = Eigen::ArrayXd::Zero(grid.size()), skirt = slope;
  for (const LinerShape& shape : options_.skirt_shapes)
    LinerShapeMap(shape, grid).add(0.0, skirt, slope);
  pad.rest -= skirt;
  if (!options_.recesses.empty()) add_recesses(pad);
  if (options_.bore) pad.liner_shapes.emplace_back(*options_.bore, grid);
  for (const LinerShape& shape : options_.bore_shapes) pad.liner_shapes.emplace_back(shape, grid);
  if (!scales_.empty()) {
    pad.scaled.emplace(grid);
    for (const ScaledShape& scaled : options_.scaled_bore) pad.scaled->add_bore(scaled.shape);
    for (const ScaledShape& scaled : options_.scaled_skirt) pad.scaled->add_skirt(scaled.shape);
  }
  if (std::isfinite(options_.ends.bottom) || std::isfinite(options_.ends.top))
    pad.ends.emplace(options_.ends, grid);
  if (on.film) {
    const Edge open = Edge::supply(viscosity_->reduced(options_.supply_pressure),
                                   options_.supply_fill, options_.oil_thickness);
    pad.film.emplace(grid, Edges{open, open, open, open, open}, options_);
  }
  if (options_.liner_layer) pad.layer.emplace(*options_.liner_layer, grid);
  if (on.asperities)
    for (Eigen::ArrayXd* values : {&pad.contact, &pad.contact_slope, &pad.contact_energy})
      values->setZero(grid.size());
  if (damping_)
    for (Eigen::ArrayXd* values : {&pad.contact_rate_slope, &pad.contact_loss})
      values->setZero(grid.size());
  if (!on.friction) return;
  pad.friction.emplace(options_.friction, grid.size());
  pad.levers.resize(grid.size(), 3);
  for (int i = 0; i < grid.n_angle(); ++i) {
    const Eigen::Vector2d arm =
        bodies_.bore_axis + grid.radius() * pad_normal(grid.angle(i)).head<2>();
    for (int j = 0; j < grid.n_axial(); ++j)
      pad.levers.row(grid.cell(i, j)) << 1.0, arm.y(), -arm.x();
  }
}

void PistonLiner::check() const {
  const PistonLinerOptions& o = options_;
  auto share = [](double value) { return value >= 0.0 && value <= 1.0; };
  require(o.effects.film || o.effects.asperities, o.name, "effects", 0.0,
          "film or asperities on: otherwise nothing separates skirt and liner");
  const double clearance = o.warm_clearance ? o.warm_clearance->minimum : o.clearance;
  require(clearance >= 0.0, o.name, "clearance", clearance, ">= 0 m");
  require(o.bore_radius > 0.0, o.name, "bore_radius", o.bore_radius, "> 0 m");
  require(o.skirt_top > o.skirt_bottom, o.name, "skirt_top", o.skirt_top, "above skirt_bottom");
  require(o.pad_span > 0.0 && o.pad_span <= std::numbers::pi, o.name, "pad_span", o.pad_span,
          "between 0 and pi rad");
  require(o.span == SkirtSpan::kPads || (o.cells_around >= kLeastAround && o.cells_around % 2 == 0),
          o.name, "cells_around", o.cells_around,
          "an even number of at least 8 around the entire skirt");
  require(!o.effects.film || o.viscosity > 0.0, o.name, "viscosity", o.viscosity, "> 0 Pa s");
  require(share(o.initial_fill), o.name, "initial_fill", o.initial_fill, "0 to 1");
  require(share(o.supply_fill), o.name, "supply_fill", o.supply_fill, "0 to 1");
  require(o.oil_thickness > 0.0, o.name, "oil_thickness", o.oil_thickness, "> 0 m");
  require(o.supply_pressure >= 0.0, o.name, "supply_pressure", o.supply_pressure, ">= 0 Pa");
  require(!o.liner_layer || std::isfinite(o.oil_thickness), o.name, "oil_thickness",
          o.oil_thickness, "finite: the layer on the liner at the start");
  require(!o.liner_layer || (o.supply_pressure == 0.0 && o.supply_fill == 1.0), o.name,
          "supply_fill", o.supply_fill,
          "1, and no supply pressure: the layer on the liner supplies the skirt");
  require(!o.liner_layer || o.effects.cavitation, o.name, "cavitation", 0.0,
          "on: the layer on the liner does not fill the gap");
  require(o.oil.pressure_coefficient >= 0.0 && o.oil.pressure_coefficient < 1e-6, o.name,
          "pressure_coefficient", o.oil.pressure_coefficient, "0 to 1e-6 1/Pa");
  require(static_cast<bool>(bodies_.stroke), o.name, "stroke", 0.0, "a stroke law");
}

double PistonLiner::stroke_height(double position, const Eigen::VectorXd& y) const {
  double height = position;
  for (const auto& [coordinate, factor] : axial_.height) height += factor * y[coordinate];
  return height;
}

// Cover, gap and their derivatives at one state; `scales` are the factors of the shapes that have
// one.
void PistonLiner::update_gap(Pad& pad, const Heights& heights,
                             const std::vector<ScaleState>& scales, const Eigen::VectorXd& y) {
  const double height = stroke_height(heights.clock, y);
  if (pad.ends) update_cover(pad, height);
  pad.gap = pad.rest;
  pad.gap_by_height.setZero();
  for (const LinerShapeMap& shape : pad.liner_shapes) shape.add(height, pad.gap, pad.gap_by_height);
  if (pad.scaled) pad.scaled->add(height, scales, pad.gap, pad.gap_by_height);
  pad.map.move(height);
  pad.map.add(y, pad.gap, pad.gap_by_height);
  if (pad.recesses) place_recesses(pad, heights.crank);
}

void PistonLiner::evaluate(const dynamics::Stage& stage, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v, bool with_tangent,
                           dynamics::Response& response) {
  find_stroke(stage, y, v);
  if (!scales_.empty()) scaled_ = scales_.at(stage, lead_);
  parallel_tasks(static_cast<int>(pads_.size()),
                 [&](int k) { evaluate_pad(*pads_[k], stage, y, v, with_tangent); });
  collect(with_tangent, response);
}

void PistonLiner::evaluate_pad(Pad& pad, const dynamics::Stage& stage, const Eigen::VectorXd& y,
                               const Eigen::VectorXd& v, bool with_tangent) {
  if (pad.film && !running_) start_content(pad, stage, y, v);
  update_gap(pad, {stroke_.position, ideal_.position}, scaled_, y);
  if (!pad.gap.allFinite())
    throw dynamics::StepRefused(options_.name + ": gap is not finite", pad.place());
  pad.map.rows(1.0, 0.0, pad.gap_by_height, pad.gap_by_y);
  pad.map.gather(v, pad.v);
  pad.load.setZero();
  if (pad.friction) pad.friction->clear(pad.ends ? &pad.cover : nullptr);
  if (pad.film) solve_film(pad, stage);
  if (asperity_) update_contact(pad);
  if (pad.friction) update_friction(pad);
  update_force(pad);
  if (!with_tangent) return;
  if (damping_) update_rate_tangent(pad, stage.kappa, v);
  update_tangent(pad);
  if (bodies_.crank.is_free()) update_crank_column(pad);
}

// The content at the start is the gap at the start, y~ = y - kappa v, filled by the scene's
// fraction, or the layer on the liner. Streamers need twice the layer to carry its flux.
void PistonLiner::start_content(Pad& pad, const dynamics::Stage& stage, const Eigen::VectorXd& y,
                                const Eigen::VectorXd& v) {
  const Eigen::VectorXd y_start = y - stage.kappa * v;
  const double start = stage.time - stage.kappa;
  const Heights heights{bodies_.stroke(start).position,
                        bodies_.stroke(start + lead_.begin.position).position};
  update_gap(pad, heights, scales_.exact(start, lead_.begin), y_start);
  if (lowest_gap(pad) <= rough_->lowest_gap())
    throw InputError(fmt::format(
        "{}: found a smallest gap of {:.3g} m at the start, expected more than {:.3g} m",
        options_.name, lowest_gap(pad), rough_->lowest_gap()));
  rough_->thicknesses(pad.gap, pad.film->cells);
  const double layers = options_.cavity == Cavity::kLayer ? 1.0 : 2.0;
  pad.film->oil.start(
      (options_.initial_fill * pad.film->cells.content).min(layers * options_.oil_thickness) *
      pad.area / pad.grid.area());
  if (!pad.layer) return;
  pad.layer->layer.start(heights.crank, options_.oil_thickness);
  pad.layer->first = pad.layer->layer.volume() + (pad.film->oil.content() * pad.grid.area()).sum();
}

void PistonLiner::solve_film(Pad& pad, const dynamics::Stage& stage) {
  const double speed = ideal_.velocity;
  PadFilm& film = *pad.film;
  const double lowest = lowest_gap(pad);
  if (lowest <= rough_->lowest_gap()) refuse_gap(pad, lowest);
  rough_->thicknesses(pad.gap, film.cells);
  if (viscosity_->varies()) {
    viscosity_->ratio(pad.grid, ideal_.position, speed, film.cells, film.viscosity_ratio,
                      film.viscosity_ratio_slope);
    divide_conductance(film.viscosity_ratio, film.viscosity_ratio_slope, film.cells);
  }
  // The liner slides past the grid at -U: the mean wall velocity is half of that.
  FilmStage inner{stage.kappa, options_.viscosity, 0.0, -0.5 * speed, false, options_.bulk_modulus};
  if (running_) inner.profile_before = &film.oil.profile();
  inner.cavity = options_.cavity;
  if (pad.ends) inner.cover = &pad.cover;
  if (pad.recesses) inner.recesses = &pad.recesses->cells;
  if (pad.layer) meet_layer(pad, stage);
  solve_film_equations(pad, stage, inner);
  pad.load += pad.area * film.pressure();
}

void PistonLiner::refuse_gap(const Pad& pad, double lowest) const {
  const auto carrying = pad.carrying();
  int cell = 0;
  while (!(carrying[cell] && pad.gap[cell] == lowest)) ++cell;
  throw dynamics::StepRefused(
      options_.name + ": gap below the film's minimum",
      fmt::format("{:.3g} m on the {} at {:.1f} deg, {:.1f} mm from the pin", lowest, pad.place(),
                  pad.grid.angle(cell / pad.grid.n_axial()) * 180.0 / std::numbers::pi,
                  1e3 * pad.grid.axial(cell % pad.grid.n_axial())));
}

void PistonLiner::solve_film_equations(Pad& pad, const dynamics::Stage& stage,
                                       const FilmStage& inner) {
  PadFilm& film = *pad.film;
  try {
    pad.film_solves +=
        film.reynolds.solve(film.cells, film.oil.before(film.reynolds, stage.weights), inner);
  } catch (const NumericsError& error) {
    throw dynamics::StepRefused(options_.name + ": the film's equations were not solved",
                                fmt::format("{}: {}", pad.place(), error.what()));
  }
  if (viscosity_->pressure_coefficient() > 0.0 &&
      !viscosity_->pressure(film.reynolds.pressure(), film.thick_pressure, film.thickening))
    throw dynamics::StepRefused(options_.name + ": no film pressure carries the load",
                                fmt::format("{}: {:.3g} Pa reduced pressure", pad.place(),
                                            film.reynolds.pressure().maxCoeff()));
}

void PistonLiner::update_friction(Pad& pad) {
  const double speed = ideal_.velocity;
  if (pad.film) {
    PadFilm& film = *pad.film;
    rough_->shear(pad.gap, film.cells, film.shear);
    if (viscosity_->varies())
      multiply_shear(film.viscosity_ratio, film.viscosity_ratio_slope, film.shear.inverse,
                     film.shear.inverse_slope);
    FilmPressure pressure{film.pressure()};
    if (film.thickening.size() > 0) {
      pressure.thickening = &film.thickening;
      pressure.coefficient = viscosity_->pressure_coefficient();
    }
    pad.friction->add_film(film.reynolds, pressure, film.shear, options_.viscosity, speed);
  }
  if (asperity_)
    pad.friction->add_contact(pad.grid, pad.contact, pad.contact_slope, pad.contact_rate_slope,
                              speed);
}

Eigen::Vector3d PistonLiner::friction_wrench(const Pad& pad) const {
  return pad.levers.transpose() * pad.friction->force().matrix();
}

}  // namespace clatter::film
