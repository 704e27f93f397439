// SPDX-License-Identifier: GPL-3.0-or-later
// [[load]], [[case]].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "assembly/recipe/recipe_reader.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"

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

/// Nodes of several regions get the mean of their rises.
Eigen::VectorXd RecipeReader::rise_of_regions(const Config& table) const {
  const Config given = table.table("regions");
  std::vector<double> rise(mesh_.regions.size(), 0.0);
  for (const std::string& name : given.keys())
    rise[static_cast<size_t>(region(given, name, name))] = given.number(name);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(mesh_.nodes.rows()), regions = sum;
  for (size_t r = 0; r < rise.size(); ++r) {
    std::vector<bool> inside(static_cast<size_t>(sum.size()), false);
    for (const mesh::CellBlock& block : mesh_.cells)
      if (static_cast<size_t>(block.region) == r)
        for (const int32_t node : block.nodes.reshaped()) inside[static_cast<size_t>(node)] = true;
    for (Eigen::Index a = 0; a < sum.size(); ++a)
      if (inside[static_cast<size_t>(a)]) sum(a) += rise[r], regions(a) += 1.0;
  }
  return sum.cwiseQuotient(regions);
}

/// The columns of the file of key `table` at the nodes of the mesh, or of the surface `on` (n_nodes
/// rows, others 0); says how far these nodes are from the points, and how far the points are from
/// linear fits. A table that is farther from the part than the part is large is refused.
RowMatrix RecipeReader::values_of_table(const Config& table,
                                        const std::vector<TableColumn>& columns,
                                        const std::string& on, Recipe& recipe) const {
  constexpr double kCoarse = 0.05;  // of the table's range: an error of 5 % of the load's variation
  constexpr double kConstant = 1e-9;  // of its values: a smaller range is rounding
  const std::filesystem::path path = table.path("table");
  recipe.files.push_back(path);
  const PointTable points = read_point_table(path, metre_, columns);
  std::vector<int32_t> nodes(static_cast<size_t>(mesh_.nodes.rows()));
  if (on.empty())
    std::iota(nodes.begin(), nodes.end(), 0);
  else
    nodes = mesh::nodes_of(mesh_.surface(on));
  const TableValues found = values_at(points, mesh_.nodes(nodes, Eigen::all));
  const double size = (mesh_.nodes.colwise().maxCoeff() - mesh_.nodes.colwise().minCoeff()).norm();
  if (found.farthest > size)
    table.fail("table",
               fmt::format("a node lies {:.3g} m from the nearest point of {}, farther than the "
                           "part is large, {:.3g} m: are its positions in another length_unit?",
                           found.farthest, path.filename().string(), size));
  RowMatrix values = RowMatrix::Zero(mesh_.nodes.rows(), points.values.cols());
  values(nodes, Eigen::all) = found.values;
  for (size_t k = 0; k < columns.size(); ++k) {
    const auto c = static_cast<Eigen::Index>(k);
    const double least = points.values.col(c).minCoeff();
    const double range = points.values.col(c).maxCoeff() - least;
    const double rounding = kConstant * points.values.col(c).cwiseAbs().maxCoeff();
    if (columns[k].above) values(nodes, c) = found.values.col(c).cwiseMax(least);
    const std::string text = fmt::format(
        "{}: {}: nodes are at most {:.3g} mm from a point; linear fits to the points leave at most "
        "{:.2g} of {:.4g} {}",
        path.filename().string(), columns[k].name, found.farthest / kMilli, found.residuals(c),
        range, columns[k].unit);
    if (found.residuals(c) > kCoarse * std::max(range, rounding))
      warn(text + ": the table is coarse for its field, give more points there");
    else
      say(text);
  }
  return values;
}

/// A rise everywhere or by regions, or temperatures above a reference: of a field of the mesh, a
/// [[heat]], or a table.
void RecipeReader::temperature_load(const Config& table, LoadSpec& spec, Recipe& recipe) const {
  spec.kind = LoadSpec::Kind::kTemperature;
  const std::vector<std::string> sources = {"value", "regions", "field", "heat", "table"};
  std::string source;
  for (const std::string& key : sources) {
    if (!table.has(key)) continue;
    if (!source.empty())
      table.fail(key, fmt::format("found {} as well, expected one of: {}", source,
                                  fmt::join(sources, ", ")));
    source = key;
  }
  const auto reference = [&] {
    return kZeroCelsius + table.number_or("reference_c", 20.0, {-kZeroCelsius});
  };
  if (source == "regions") {
    spec.rise = rise_of_regions(table);
    spec.unit = table.text_or("unit", "1");
  } else if (source == "heat") {
    spec.heat = table.text("heat");
    std::vector<std::string> names;
    for (const HeatSpec& heat : recipe.heats) names.push_back(heat.name);
    if (std::find(names.begin(), names.end(), spec.heat) == names.end())
      fail_unknown(table, "heat", spec.heat, names);
    spec.value = reference();
    spec.unit = table.text_or("unit", "1");
  } else if (source == "table") {
    const std::vector<TableColumn> columns = {{"temperature_c", "degrees Celsius", -kZeroCelsius}};
    spec.rise = values_of_table(table, columns, "", recipe).array() + kZeroCelsius - reference();
    spec.unit = table.text_or("unit", "1");
  } else if (source == "field") {
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
  for (const std::string& name : table.texts_or("regions", {}))
    spec.rotating.push_back(region(table, "regions", name));
}

LoadSpec RecipeReader::load(const Config& table, Recipe& recipe) const {
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
    if (table.has("table")) {
      spec.pressure = values_of_table(table, {{"pressure", "Pa"}}, spec.surface, recipe).col(0);
      spec.unit = table.text_or("unit", "1");
    }
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
    temperature_load(table, spec, recipe);
  } else if (kind == "nodal") {
    spec.kind = LoadSpec::Kind::kNodal;
    spec.field = field(table, 3);
    spec.value = table.number_or("scale", 1.0);
    spec.unit = table.text_or("unit", "1");
  } else if (table.has("field")) {
    if (table.has("direction"))
      table.fail("field", "direction and field exclude each other: a field has its directions");
    spec.kind = LoadSpec::Kind::kAcceleration;
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
    recipe.loads.push_back(load(table, recipe));
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
