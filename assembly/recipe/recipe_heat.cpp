// SPDX-License-Identifier: GPL-3.0-or-later
// [[heat]].
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "assembly/recipe/recipe_reader.hpp"

namespace clatter::assembly {

/// A number, or a list of them at the positions `at` along the direction `along`.
/// @param offset added to each: from degrees Celsius to kelvin.
Profile RecipeReader::profile(const Config& table, std::string_view key, Range range,
                              double offset) const {
  Profile profile;
  if (!table.is_list(key)) {
    profile.value = {offset + table.number(key, range)};
    return profile;
  }
  profile.value = table.numbers(key);
  profile.direction = unit_vector(table, "along");
  profile.at = table.numbers("at");
  if (profile.at.size() != profile.value.size() || profile.at.empty())
    table.fail(key, fmt::format("found {} numbers for {} positions `at`, expected as many",
                                profile.value.size(), profile.at.size()));
  for (size_t k = 0; k < profile.at.size(); ++k) {
    const double value = profile.value[k];
    if (value < range.min || (range.open_min && value == range.min))
      table.fail(key, fmt::format("found {:g}, expected {} {:g}", value,
                                  range.open_min ? "above" : "at least", range.min));
    profile.at[k] *= metre_;
    if (k > 0 && !(profile.at[k] > profile.at[k - 1]))
      table.fail("at", "found positions that do not ascend, expected ascending ones");
    profile.value[k] += offset;
  }
  return profile;
}

HeatSpec::Source RecipeReader::heat_source(const Config& table) const {
  HeatSpec::Source source;
  source.regions = table.texts_or("regions", mesh_.regions);
  const double power = table.number("power");
  source.power.assign(mesh_.regions.size(), 0.0);
  for (const std::string& name : source.regions)
    source.power[static_cast<size_t>(region(table, "regions", name))] = power;
  return source;
}

/// A film by a table has the coefficient and the temperature of the fluid at each point, as
/// programs of flow write them. Fits below the smallest coefficient of the table, beyond its
/// points, are that coefficient.
HeatSpec::Film RecipeReader::film(const Config& table, Recipe& recipe) const {
  const Range celsius{-kZeroCelsius};
  const std::string on = surface(table);
  if (!table.has("table"))
    return {on, profile(table, "coefficient", Range::positive(), 0.0),
            profile(table, "temperature_c", celsius, kZeroCelsius)};
  for (const char* key : {"coefficient", "temperature_c"})
    if (table.has(key))
      table.fail(key, fmt::format("table and {} exclude each other: the table has both columns "
                                  "coefficient and temperature_c",
                                  key));
  const RowMatrix values = values_of_table(
      table,
      {{"coefficient", "W/(m2 K)", 0.0, true}, {"temperature_c", "degrees Celsius", -kZeroCelsius}},
      on, recipe);
  HeatSpec::Film film{on, {}, {}};
  film.coefficient.nodal = values.col(0);
  film.temperature.nodal = values.col(1).array() + kZeroCelsius;
  return film;
}

HeatSpec::Flux RecipeReader::flux(const Config& table, Recipe& recipe) const {
  const std::string on = surface(table);
  if (!table.has("table")) return {on, profile(table, "flux", {}, 0.0)};
  if (table.has("flux"))
    table.fail("flux", "table and flux exclude each other: the table has the column flux");
  HeatSpec::Flux flux{on, {}};
  flux.flux.nodal = values_of_table(table, {{"flux", "W/m2"}}, on, recipe).col(0);
  return flux;
}

HeatSpec RecipeReader::heat(const Config& table, Recipe& recipe) const {
  const Range celsius{-kZeroCelsius};
  HeatSpec spec;
  spec.name = table.text("name");
  if (spec.name.empty() || spec.name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without '/'", spec.name));
  spec.where = where(table, "heat " + spec.name);
  for (const Config& one : table.tables("film")) spec.films.push_back(film(one, recipe));
  for (const Config& one : table.tables("flux")) spec.fluxes.push_back(flux(one, recipe));
  for (const Config& one : table.tables("fixed"))
    spec.fixed.push_back(
        {selection(one, "heat " + spec.name), kZeroCelsius + one.number("temperature_c", celsius)});
  for (const Config& one : table.tables("source")) spec.sources.push_back(heat_source(one));
  std::vector<std::string> ties;
  for (const TieSpec& tie : recipe.ties) ties.push_back(tie.name);
  for (const Config& one : table.tables("contact")) {
    const std::string tie = one.text("tie");
    if (std::find(ties.begin(), ties.end(), tie) == ties.end()) fail_unknown(one, "tie", tie, ties);
    for (const HeatSpec::Contact& other : spec.contacts)
      if (other.tie == tie)
        one.fail("tie", fmt::format("found \"{}\" twice, expected one conductance", tie));
    spec.contacts.push_back({tie, one.number("conductance", Range::positive())});
  }
  return spec;
}

void RecipeReader::heats(Recipe& recipe) const {
  std::set<std::string> names;
  for (const Config& table : config_.tables("heat")) {
    recipe.heats.push_back(heat(table, recipe));
    if (!names.insert(recipe.heats.back().name).second)
      table.fail("name", fmt::format("found \"{}\" twice, expected different names",
                                     recipe.heats.back().name));
    for (size_t r = 0; r < recipe.materials.size(); ++r)
      if (recipe.materials[r].conductivity.isZero(0.0))
        table.fail("name", fmt::format("found no conductivity of the material of region \"{}\", "
                                       "expected one [W/(m K)]",
                                       mesh_.regions[r]));
  }
}

}  // namespace clatter::assembly
