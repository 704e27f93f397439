// SPDX-License-Identifier: GPL-3.0-or-later
// [[heat]].
#include <fmt/format.h>

#include "assembly/recipe/recipe_keys.hpp"

namespace clatter::assembly {
namespace {

/// The row of a number or of a list of them at positions, and the rows of the positions.
template <class Rows>
keys::Row profile_row(Rows& key, const std::string& name, Profile& profile, Range range,
                      const std::string& meaning) {
  return key.one_or_more(name, profile.value, range, meaning + ", or a list of them at positions");
}

/// A row of a table of points in place of `names`.
template <class Rows>
void table_row(Rows& key, std::filesystem::path& path, const std::vector<std::string>& names,
               std::string meaning) {
  key.path("table", path, std::move(meaning));
  for (const std::string& name : names) key.one_of({name, "table"});
}

template <class Rows>
void position_rows(Rows& key, Profile& profile) {
  key.direction("along", profile.direction, "direction of the positions").needs("at");
  key.numbers("at", profile.at, {}, "ascending positions along it").needs("along").in_length_unit();
}

/// Gives each profile that is a list the positions, which belong to lists alone.
void finish_profiles(const Config& table, const Profile& positions,
                     const std::vector<std::pair<const char*, Profile*>>& profiles) {
  const Profile at = positions;
  bool any = false;
  for (const auto& [key, profile] : profiles) {
    profile->direction.setZero();
    profile->at.clear();
    if (!table.is_list(key)) continue;
    any = true;
    for (const char* needed : {"along", "at"})
      if (!table.has(needed))
        table.fail(needed, fmt::format("is missing, the list {} needs it", key));
    if (at.at.size() != profile->value.size() || at.at.empty())
      table.fail(key, fmt::format("found {} numbers for {} positions `at`, expected as many",
                                  profile->value.size(), at.at.size()));
    profile->direction = at.direction;
    profile->at = at.at;
  }
  if (!any && table.has("along")) table.fail("along", "needs a list of numbers at positions");
  for (size_t k = 1; k < at.at.size(); ++k)
    if (!(at.at[k] > at.at[k - 1]))
      table.fail("at", "found positions that do not ascend, expected ascending ones");
}

const Range kCelsius{-kZeroCelsius};

}  // namespace

/// The coefficient and the temperature of the fluid at each point, as programs of flow write them.
/// Fits below the smallest coefficient of the table, beyond its points, are that coefficient.
void RecipeKeys::read_film(const Config& table, HeatSpec::Film& film) {
  const RowMatrix values = values_of_table(
      table, film.table,
      {{"coefficient", "W/(m2 K)", 0.0, true}, {"temperature_c", "degrees Celsius", -kZeroCelsius}},
      film.surface);
  film.coefficient.nodal = values.col(0);
  film.temperature.nodal = values.col(1).array() + kZeroCelsius;
}

const keys::Keys<HeatSpec::Film>& RecipeKeys::film_keys() {
  const auto rows = [this](auto& key, HeatSpec::Film& film) {
    key.text("surface", film.surface, "a surface of the mesh").required();
    profile_row(key, "coefficient", film.coefficient, Range::positive(),
                "heat transfer coefficient")
        .shown_in("W/(m2 K)");
    profile_row(key, "temperature_c", film.temperature, kCelsius, "temperature of the fluid");
    position_rows(key, film.coefficient);
    table_row(key, film.table, {"coefficient", "temperature_c"},
              "CSV file of points with the columns coefficient and temperature_c; interpolated");
    key.check([this](const Config& table, HeatSpec::Film& f) {
      names_.check_surface(table, f.surface);
      finish_profiles(table, f.coefficient,
                      {{"coefficient", &f.coefficient}, {"temperature_c", &f.temperature}});
      if (!f.table.empty()) read_film(table, f);
    });
  };
  return keep<HeatSpec::Film>("film", "a fluid at a surface", rows);
}

const keys::Keys<HeatSpec::Flux>& RecipeKeys::flux_keys() {
  const auto rows = [this](auto& key, HeatSpec::Flux& flux) {
    key.text("surface", flux.surface, "a surface of the mesh").required();
    profile_row(key, "flux", flux.flux, {}, "heat flux into the part").shown_in("W/m2");
    position_rows(key, flux.flux);
    table_row(key, flux.table, {"flux"}, "CSV file of points with the column flux; interpolated");
    key.check([this](const Config& table, HeatSpec::Flux& f) {
      names_.check_surface(table, f.surface);
      finish_profiles(table, f.flux, {{"flux", &f.flux}});
      if (!f.table.empty())
        f.flux.nodal = values_of_table(table, f.table, {{"flux", "W/m2"}}, f.surface).col(0);
    });
  };
  return keep<HeatSpec::Flux>("flux", "heat through a surface", rows);
}

const keys::Keys<HeatSpec::Fixed>& RecipeKeys::fixed_keys() {
  const auto rows = [this](auto& key, HeatSpec::Fixed& fixed) {
    select_by(key, fixed.selection, {"surface", "node_set"});
    key.number("temperature_c", fixed.temperature, kCelsius, "temperature of the nodes").required();
    key.check(
        [this](const Config& table, HeatSpec::Fixed& f) { names_.check(table, "", f.selection); });
  };
  return keep<HeatSpec::Fixed>("fixed", "a given temperature", rows);
}

const keys::Keys<HeatSpec::Source>& RecipeKeys::source_keys() {
  const auto rows = [this](auto& key, HeatSpec::Source& source) {
    key.texts("regions", source.regions, "names of regions of the mesh; all without it");
    key.number("power", source.value, {}, "heat per volume").required().shown_in("W/m3");
    key.check([this](const Config& table, HeatSpec::Source& s) {
      if (!table.has("regions")) s.regions = names_.mesh.regions;
      s.power.assign(names_.mesh.regions.size(), 0.0);
      for (const std::string& name : s.regions)
        s.power[names_.region(table, "regions", name)] = s.value;
    });
  };
  return keep<HeatSpec::Source>("source", "heat that regions generate", rows);
}

const keys::Keys<HeatSpec::Contact>& RecipeKeys::conductance_keys() {
  const auto rows = [this](auto& key, HeatSpec::Contact& contact) {
    key.text("tie", contact.tie, "name of the [[tie]] or [[bolt]]").required().distinct();
    key.number("conductance", contact.conductance, Range::positive(),
               "heat transfer coefficient of the joint")
        .required()
        .shown_in("W/(m2 K)");
    key.check([this](const Config& table, HeatSpec::Contact& c) {
      check_known(table, "tie", c.tie, names_.ties);
    });
  };
  return keep<HeatSpec::Contact>("contact", "a tie or bolt whose sides have different temperatures",
                                 rows);
}

const keys::Keys<HeatSpec>& RecipeKeys::heat_keys() {
  const auto rows = [this](auto& key, HeatSpec& heat) {
    key.name("name", heat.name, "name for loads").required().distinct();
    key.tables("film", heat.films, film_keys());
    key.tables("flux", heat.fluxes, flux_keys());
    key.tables("fixed", heat.fixed, fixed_keys());
    key.tables("source", heat.sources, source_keys());
    key.tables("contact", heat.contacts, conductance_keys());
    key.check([this](const Config& table, HeatSpec& h) {
      h.where = where(table, "heat " + h.name);
      for (HeatSpec::Fixed& fixed : h.fixed) fixed.selection.where += ": heat " + h.name;
      names_.heats.insert(h.name);
      for (size_t r = 0; r < materials_.size(); ++r)
        if (materials_[r].conductivity.isZero(0.0))
          table.fail("name", fmt::format("found no conductivity of the material of region \"{}\", "
                                         "expected one [W/(m K)]",
                                         names_.mesh.regions[r]));
    });
  };
  return keep<HeatSpec>("heat", "a steady temperature field", rows);
}

}  // namespace clatter::assembly
