// SPDX-License-Identifier: GPL-3.0-or-later
// [[heat]].
#include <fmt/format.h>

#include "core/recipe/tables.hpp"

namespace clatter::recipe {
namespace {

/// The row of a number or of a list of them at positions.
template <class Rows>
Row profile_row(Rows& key, const std::string& name, std::vector<double>& values, Range range,
                const std::string& meaning) {
  return key.one_or_more(name, values, range, meaning + ", or a list of them at positions");
}

/// A row of a table of points in place of `names`.
template <class Rows>
void table_row(Rows& key, std::filesystem::path& path, const std::vector<std::string>& names,
               std::string meaning) {
  key.path("table", path, std::move(meaning));
  for (const std::string& name : names) key.one_of({name, "table"});
}

template <class Rows>
void position_rows(Rows& key, Heat::Positions& positions) {
  key.direction("along", positions.along, "direction of the positions").needs("at");
  key.numbers("at", positions.at, {}, "ascending positions along it")
      .needs("along")
      .in_length_unit();
}

/// Lists, and they alone, have positions; a list of one is a number.
void check_positions(const Config& table, Heat::Positions& positions,
                     const std::vector<std::pair<const char*, const std::vector<double>*>>& rows) {
  bool any = false;
  for (const auto& [key, values] : rows) {
    if (!table.is_list(key)) continue;
    any = true;
    for (const char* needed : {"along", "at"})
      if (!table.has(needed))
        table.fail(needed, fmt::format("is missing, the list {} needs it", key));
    if (positions.at.size() != values->size() || values->empty())
      table.fail(key, fmt::format("found {} numbers for {} positions `at`, expected as many",
                                  values->size(), positions.at.size()));
  }
  if (!any && table.has("along")) table.fail("along", "needs a list of numbers at positions");
  for (size_t k = 1; k < positions.at.size(); ++k)
    if (!(positions.at[k] > positions.at[k - 1]))
      table.fail("at", "found positions that do not ascend, expected ascending ones");
  if (positions.at.size() == 1) positions = {};
}

constexpr Range kCelsius{-273.15};

const Keys<Heat::Film>& film_keys() {
  static const Keys<Heat::Film> keys(
      "film", "a fluid at a surface", [](auto& key, Heat::Film& film) {
        key.source(film.source);
        key.text("surface", film.surface, "a surface of the mesh").required();
        profile_row(key, "coefficient", film.coefficient, Range::positive(),
                    "heat transfer coefficient")
            .shown_in("W/(m2 K)");
        profile_row(key, "temperature_c", film.temperature, kCelsius, "temperature of the fluid");
        position_rows(key, film.positions);
        table_row(
            key, film.table, {"coefficient", "temperature_c"},
            "CSV file of points with the columns coefficient and temperature_c; interpolated");
        key.check([](const Config& table, Heat::Film& f) {
          check_positions(table, f.positions,
                          {{"coefficient", &f.coefficient}, {"temperature_c", &f.temperature}});
        });
      });
  return keys;
}

const Keys<Heat::Flux>& flux_keys() {
  static const Keys<Heat::Flux> keys(
      "flux", "heat through a surface", [](auto& key, Heat::Flux& flux) {
        key.source(flux.source);
        key.text("surface", flux.surface, "a surface of the mesh").required();
        profile_row(key, "flux", flux.flux, {}, "heat flux into the part").shown_in("W/m2");
        position_rows(key, flux.positions);
        table_row(key, flux.table, {"flux"},
                  "CSV file of points with the column flux; interpolated");
        key.check([](const Config& table, Heat::Flux& f) {
          check_positions(table, f.positions, {{"flux", &f.flux}});
        });
      });
  return keys;
}

const Keys<Heat::Fixed>& fixed_keys() {
  static const Keys<Heat::Fixed> keys(
      "fixed", "a given temperature", [](auto& key, Heat::Fixed& fixed) {
        key.source(fixed.source);
        select_by(key, fixed.selection, {"surface", "node_set"});
        key.number("temperature_c", fixed.temperature, kCelsius, "temperature of the nodes")
            .required();
      });
  return keys;
}

const Keys<Heat::HeatSource>& heat_source_keys() {
  static const Keys<Heat::HeatSource> keys(
      "source", "heat that regions generate", [](auto& key, Heat::HeatSource& source) {
        key.source(source.source);
        key.texts("regions", source.regions, "names of regions of the mesh; all without it");
        key.number("power", source.power, {}, "heat per volume").required().shown_in("W/m3");
        key.check([](const Config& table, Heat::HeatSource& s) {
          if (table.has("regions") && s.regions.empty())
            table.fail("regions", "found none, expected one or more names");
        });
      });
  return keys;
}

const Keys<Heat::Conductance>& conductance_keys() {
  static const Keys<Heat::Conductance> keys(
      "contact", "a tie or bolt whose sides have different temperatures",
      [](auto& key, Heat::Conductance& contact) {
        key.source(contact.source);
        key.text("tie", contact.tie, "name of the [[tie]] or [[bolt]]").required().distinct();
        key.number("conductance", contact.conductance, Range::positive(),
                   "heat transfer coefficient of the joint")
            .required()
            .shown_in("W/(m2 K)");
      });
  return keys;
}

}  // namespace

const Keys<Heat>& heat_keys() {
  static const Keys<Heat> keys("heat", "a steady temperature field", [](auto& key, Heat& heat) {
    key.source(heat.source);
    key.name("name", heat.name, "name for loads").required().distinct();
    key.tables("film", heat.films, film_keys());
    key.tables("flux", heat.fluxes, flux_keys());
    key.tables("fixed", heat.fixed, fixed_keys());
    key.tables("source", heat.sources, heat_source_keys());
    key.tables("contact", heat.contacts, conductance_keys());
  });
  return keys;
}

}  // namespace clatter::recipe
