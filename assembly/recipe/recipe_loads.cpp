// SPDX-License-Identifier: GPL-3.0-or-later
// [[load]], [[case]].
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "assembly/recipe/recipe_reader.hpp"

namespace clatter::assembly {

void RecipeReader::force_load(const Config& table, LoadSpec& spec) const {
  spec.kind = LoadSpec::Kind::kForce;
  spec.set = known_set(table, "set");
  if (table.has("force")) spec.force = vector(table, "force");
  if (table.has("moment")) spec.moment = vector(table, "moment");
  if (spec.force.isZero(0.0) && spec.moment.isZero(0.0))
    table.fail("force", "found neither a force [N] nor a moment [N m], expected one");
  spec.unit = table.text_or("unit", "1");
}

void RecipeReader::displacement_load(const Config& table, LoadSpec& spec) const {
  spec.kind = LoadSpec::Kind::kDisplacement;
  spec.selection = selection(table, "load " + spec.name, true);
  spec.directions = directions(table, "directions", {}, spec.selection.point.empty() ? 3 : 6);
  if (spec.directions.empty())
    table.fail("directions", "found nothing, expected the directions that move");
  spec.axes = axes(table);
  const bool turns = spec.directions.back() >= 3;
  for (const int d : spec.directions)
    if ((d >= 3) != turns)
      table.fail("directions", "found displacements and rotations, expected one of them");
  spec.value = (turns ? 1.0 : metre_) * table.number("value");
  spec.unit = table.text_or("unit", "1");
}

/// The name of a field of the mesh with `columns` values a node.
std::string RecipeReader::field(const Config& table, Eigen::Index columns) const {
  const std::string name = table.text("field");
  if (!mesh_.fields.contains(name)) fail_unknown(table, "field", name, names_of(mesh_.fields));
  const RowMatrix& values = mesh_.fields.at(name);
  if (values.rows() != mesh_.nodes.rows() || values.cols() != columns)
    table.fail("field", fmt::format("found {} x {} values, expected {} x {}", values.rows(),
                                    values.cols(), mesh_.nodes.rows(), columns));
  return name;
}

/// A rise everywhere, or a field of temperatures above `reference`.
void RecipeReader::temperature_load(const Config& table, LoadSpec& spec) const {
  spec.kind = LoadSpec::Kind::kTemperature;
  if (table.has("field")) {
    if (table.has("value")) table.fail("value", "found a field as well, expected one");
    spec.field = field(table, 1);
    spec.value = table.number_or("reference", 0.0);
    spec.unit = table.text_or("unit", "1");
  } else {
    spec.value = table.number_or("value", 1.0);
    spec.unit = table.text_or("unit", spec.value == 1.0 ? "K" : "1");
  }
}

/// 1 (rad/s)^2 about an axis, of all regions and point masses or of some regions.
void RecipeReader::centrifugal_load(const Config& table, LoadSpec& spec) const {
  spec.kind = LoadSpec::Kind::kCentrifugal;
  spec.axis.direction = unit_vector(table, "axis");
  spec.axis.point = point(table, "axis_point");
  spec.unit = "rad2/s2";
  for (const std::string& region : table.texts_or("regions", {})) {
    const auto found = std::find(mesh_.regions.begin(), mesh_.regions.end(), region);
    if (found == mesh_.regions.end()) fail_unknown(table, "regions", region, mesh_.regions);
    spec.rotating.push_back(static_cast<int32_t>(found - mesh_.regions.begin()));
  }
}

LoadSpec RecipeReader::load(const Config& table) const {
  LoadSpec spec;
  spec.name = table.text("name");
  if (spec.name.empty() || spec.name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without '/'", spec.name));
  spec.where = where(table, "load " + spec.name);
  const std::string kind =
      table.choice("kind", {"pressure", "resultant", "force", "gravity", "acceleration",
                            "centrifugal", "displacement", "nodal", "temperature"});
  if (kind == "pressure") {
    spec.surface = surface(table);
    spec.unit = "Pa";
  } else if (kind == "resultant") {
    spec.kind = LoadSpec::Kind::kResultant;
    spec.surface = surface(table);
    spec.force = table.number_or("total", 1.0) * unit_vector(table, "direction");
    spec.unit = table.text_or("unit", "N");
  } else if (kind == "force") {
    force_load(table, spec);
  } else if (kind == "centrifugal") {
    centrifugal_load(table, spec);
  } else if (kind == "displacement") {
    displacement_load(table, spec);
  } else if (kind == "temperature") {
    temperature_load(table, spec);
  } else if (kind == "nodal") {
    spec.kind = LoadSpec::Kind::kNodal;
    spec.field = field(table, 3);
    spec.value = table.number_or("scale", 1.0);
    spec.unit = table.text_or("unit", "1");
  } else {
    spec.kind = LoadSpec::Kind::kGravity;
    spec.force = unit_vector(table, "direction");
    spec.unit = "m/s2";
  }
  return spec;
}

namespace {

bool expands(const std::vector<fe::Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const fe::Material& material) { return !material.expansion.isZero(0.0); });
}

}  // namespace

void RecipeReader::loads(Recipe& recipe) const {
  std::set<std::string> names;
  for (const Config& table : config_.tables("load")) {
    recipe.loads.push_back(load(table));
    if (recipe.loads.back().kind == LoadSpec::Kind::kTemperature && !expands(recipe.materials))
      table.fail("kind", "found temperature, no material has an expansion");
    if (!names.insert(recipe.loads.back().name).second)
      table.fail("name", fmt::format("found \"{}\" twice, expected different names",
                                     recipe.loads.back().name));
  }
}

void RecipeReader::cases(Recipe& recipe) const {
  std::vector<std::string> names;
  for (const LoadSpec& load : recipe.loads) names.push_back(load.name);
  for (const Config& table : config_.tables("case")) {
    const std::string name = table.text("name");
    if (name.empty() || name.find('/') != std::string::npos)
      table.fail("name", fmt::format("found \"{}\", expected a name without '/'", name));
    const bool taken = std::find(names.begin(), names.end(), name) != names.end();
    if (taken || recipe.cases.contains(name))
      table.fail("name", fmt::format("found \"{}\" twice, expected different names of loads and "
                                     "cases",
                                     name));
    const Config factors = table.table("loads");
    for (const std::string& load : factors.keys()) {
      if (std::find(names.begin(), names.end(), load) == names.end())
        fail_unknown(factors, load, load, names);
      recipe.cases[name][load] = factors.number(load);
    }
    if (!recipe.cases.contains(name)) table.fail("loads", "found none, expected at least one");
  }
}

}  // namespace clatter::assembly
