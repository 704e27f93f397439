// SPDX-License-Identifier: GPL-3.0-or-later
// [[heat]].
#include <fmt/format.h>

#include <algorithm>

#include "assembly/recipe/resolve.hpp"

namespace clatter::assembly {
namespace {

/// A number has no positions, a list has one for each.
Profile profile(const std::vector<double>& values, const recipe::Heat::Positions& positions) {
  if (values.size() != positions.at.size()) return {Eigen::Vector3d::Zero(), {}, values};
  return {positions.along, positions.at, values};
}

}  // namespace

/// A table has the coefficient and the temperature of the fluid at each point, as programs of flow
/// write them. Fits below the smallest coefficient of the table, beyond its points, are that
/// coefficient.
HeatSpec::Film Resolver::film(const recipe::Heat::Film& film) {
  names_.check_surface(film.source, film.surface);
  HeatSpec::Film spec{film.surface, profile(film.coefficient, film.positions),
                      profile(film.temperature, film.positions)};
  if (film.table.empty()) return spec;
  const RowMatrix values = values_of_table(
      film.source, film.table,
      {{"coefficient", "W/(m2 K)", 0.0, true}, {"temperature_c", "degrees Celsius", -kZeroCelsius}},
      film.surface);
  spec.coefficient.nodal = values.col(0);
  spec.temperature.nodal = values.col(1).array() + kZeroCelsius;
  return spec;
}

HeatSpec::Flux Resolver::flux(const recipe::Heat::Flux& flux) {
  names_.check_surface(flux.source, flux.surface);
  HeatSpec::Flux spec{flux.surface, profile(flux.flux, flux.positions)};
  if (!flux.table.empty())
    spec.flux.nodal =
        values_of_table(flux.source, flux.table, {{"flux", "W/m2"}}, flux.surface).col(0);
  return spec;
}

HeatSpec::Source Resolver::source(const recipe::Heat::HeatSource& source) const {
  const std::vector<std::string>& all = names_.mesh.regions;
  HeatSpec::Source spec{source.regions.empty() ? all : source.regions,
                        std::vector<double>(all.size(), 0.0)};
  for (const std::string& name : spec.regions)
    spec.power[names_.region(source.source, "regions", name)] = source.power;
  return spec;
}

HeatSpec Resolver::heat(const recipe::Heat& heat, size_t) {
  HeatSpec spec{.name = heat.name, .where = where(heat.source, "heat " + heat.name)};
  for (const auto& one : heat.films) spec.films.push_back(film(one));
  for (const auto& one : heat.fluxes) spec.fluxes.push_back(flux(one));
  for (const auto& one : heat.fixed)
    spec.fixed.push_back(
        {names_.selection(one.source, "heat " + heat.name, one.selection), one.temperature});
  for (const auto& one : heat.sources) spec.sources.push_back(source(one));
  for (const auto& one : heat.contacts) check_known(one.source, "tie", one.tie, names_.ties);
  spec.contacts = heat.contacts;
  names_.heats.insert(heat.name);
  for (size_t r = 0; r < materials_.size(); ++r) {
    const std::vector<fe::ShellLayer>& layers = sections_[r].layers;
    const bool insulates = layers.empty()
                               ? materials_[r].conductivity.isZero(0.0)
                               : std::ranges::any_of(layers, [](const fe::ShellLayer& layer) {
                                   return layer.material.conductivity.isZero(0.0);
                                 });
    if (insulates)
      heat.source.fail("name",
                       fmt::format("found no conductivity of {} of region \"{}\", expected one "
                                   "[W/(m K)]",
                                   layers.empty() ? "the material" : "a material in the layers",
                                   names_.mesh.regions[r]));
  }
  return spec;
}

}  // namespace clatter::assembly
