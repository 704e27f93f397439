// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/contact_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"

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

int patches_of(const std::optional<ElasticSurface>& surface) {
  return surface ? static_cast<int>(surface->grid.angle.size() * surface->grid.axial.size()) : 0;
}

// Ends that are not given are those of the patches.
void complete_ends(const rom::ContactGrid& grid, LinerEnds& ends) {
  if (grid.axial_edges.size() < 2) return;
  const double origin = grid.axis_point.z(), first = grid.axial_edges[0] * grid.axis.z(),
               last = grid.axial_edges[grid.axial_edges.size() - 1] * grid.axis.z();
  if (std::isinf(ends.bottom)) ends.bottom = origin + std::min(first, last);
  if (std::isinf(ends.top)) ends.top = origin + std::max(first, last);
}

}  // namespace

ContactModel::ContactModel(PistonLinerOptions given, PistonLinerBodies given_bodies, int size)
    : options(std::move(given)), bodies(std::move(given_bodies)) {
  check();
  complete_oil();
  if (options.effects.asperities) {
    asperity.emplace(options.asperity);
    if (options.damping.loss_factor > 0.0) damping.emplace(options.damping);
  }
  at = {patches_of(bodies.piston), patches_of(bodies.liner)};
  if (size != at.size())
    throw InputError(
        fmt::format("{}: found {} coordinates, expected {}", options.name, size, at.size()));
  complete_shape();
  recesses = options.recesses;
  for (Recess& one : recesses)
    if (viscosity) one.pressure = viscosity->reduced(one.pressure);
}

void ContactModel::complete_oil() {
  if (!options.effects.cavitation) {  // every cell is full: no setting of partial filling applies
    options.initial_fill = options.supply_fill = 1.0;
    options.oil_thickness = std::numeric_limits<double>::infinity();
    for (Recess& recess : options.recesses) {
      recess.kind = Recess::Kind::kGroove;
      recess.fill = 1.0;
    }
  }
  if (options.effects.film) {
    rough.emplace(options.roughness);
    viscosity.emplace(options.oil, options.viscosity);
    options.viscosity = viscosity->reference();
  } else {
    options.liner_layer.reset();
  }
}

void ContactModel::complete_shape() {
  const int count = at.size() + (bodies.crank.is_free() ? 1 : 0);
  if (bodies.liner) {
    complete_ends(bodies.liner->grid, options.ends);
    const LinerAxial liner{at.axial(), at.liner_fit() + 2};
    axial = axial_motion(count, at.pin(), bodies.liner_axial, &liner);
  } else {
    axial = axial_motion(count, at.pin(), bodies.bore_axis, nullptr);
  }
  if (options.liner_layer) {
    LinerLayerOptions& layer = *options.liner_layer;
    layer.bottom = std::max(layer.bottom, options.ends.bottom);
    layer.top = std::min(layer.top, options.ends.top);
  }
  if (options.warm_clearance)
    options.clearance =
        options.warm_clearance->minimum - nearest_point(options, *options.warm_clearance).gap;
  height_by_y.setZero(at.size());
  for (const auto& [coordinate, factor] : axial.height) height_by_y[coordinate] += factor;
}

void ContactModel::check() const {
  const PistonLinerOptions& o = options;
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
  require(static_cast<bool>(bodies.stroke), o.name, "stroke", 0.0, "a stroke law");
}

double ContactModel::height(double position, const Eigen::VectorXd& y) const {
  double height = position;
  for (const auto& [coordinate, factor] : axial.height) height += factor * y[coordinate];
  return height;
}

}  // namespace clatter::film
