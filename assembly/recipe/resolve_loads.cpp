// SPDX-License-Identifier: GPL-3.0-or-later
// [[load]], [[case]].
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "assembly/recipe/resolve.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"

namespace clatter::assembly {
namespace {

using Kind = LoadSpec::Kind;

/// Displacements or rotations, whose amount is a length or an angle.
void check_displacement(const RecipeNames& names, const LoadSpec& load) {
  if (load.selection.surface.empty() && load.selection.node_set.empty() &&
      load.selection.point.empty())
    load.source.fail("surface", "give surface, node_set or point");
  names.check_directions(load.source, "directions", load.selection, load.directions);
  for (const int d : load.directions)
    if (d / 3 != load.directions[0] / 3)
      load.source.fail(
          "directions",
          "displacements and rotations exclude each other: value is a length or an angle");
}

/// The unit of a load case that names none.
std::string unit_of(const LoadSpec& load) {
  switch (load.kind) {
    case Kind::kPressure:
      return load.node_pressures.size() > 0 ? "1" : "Pa";
    case Kind::kResultant:
      return "N";
    case Kind::kAcceleration:
      return load.field.empty() ? "m/s2" : "1";
    case Kind::kCentrifugal:
      return "rad2/s2";
    case Kind::kTemperature:
      return load.value.value_or(1.0) == 1.0 && load.rises.empty() && load.heat.empty() &&
                     load.table.empty() && load.field.empty()
                 ? "K"
                 : "1";
    default:
      return "1";
  }
}

}  // namespace

RowMatrix Resolver::values_of_table(const keys::Source& table, const std::filesystem::path& path,
                                    const std::vector<TableColumn>& columns,
                                    const std::string& on) {
  constexpr double kCoarse = 0.05;  // of the table's range: an error of 5 % of the load's variation
  constexpr double kConstant = 1e-9;  // of its values: a smaller range is rounding
  const mesh::Mesh& mesh = names_.mesh;
  files_.push_back(path);
  const PointTable points = read_point_table(path, metre_, columns);
  std::vector<int32_t> nodes(static_cast<size_t>(mesh.nodes.rows()));
  if (on.empty())
    std::iota(nodes.begin(), nodes.end(), 0);
  else
    nodes = mesh::nodes_of(mesh.surface(on));
  const TableValues found = values_at(points, mesh.nodes(nodes, Eigen::all));
  const double size = (mesh.nodes.colwise().maxCoeff() - mesh.nodes.colwise().minCoeff()).norm();
  if (found.farthest > size)
    table.fail("table",
               fmt::format("a node lies {:.3g} m from the nearest point of {}, farther than the "
                           "part is large, {:.3g} m: are its positions in another length_unit?",
                           found.farthest, path.filename().string(), size));
  RowMatrix values = RowMatrix::Zero(mesh.nodes.rows(), points.values.cols());
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

/// Nodes of several regions get the mean of their rises.
Eigen::VectorXd Resolver::rise_of_regions(const LoadSpec& load) const {
  std::vector<double> rise(names_.mesh.regions.size(), 0.0);
  for (const auto& [name, value] : load.rises)
    rise[names_.region(load.source.below("regions"), name, name)] = value;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(names_.mesh.nodes.rows()), regions = sum;
  for (size_t r = 0; r < rise.size(); ++r) {
    std::vector<bool> inside(static_cast<size_t>(sum.size()), false);
    const auto mark = [&](const auto& blocks) {
      for (const auto& block : blocks)
        if (static_cast<size_t>(block.region) == r)
          for (const int32_t node : block.nodes.reshaped()) inside[node] = true;
    };
    mark(names_.mesh.cells);
    mark(names_.mesh.shells);
    for (Eigen::Index a = 0; a < sum.size(); ++a)
      if (inside[a]) sum(a) += rise[r], regions(a) += 1.0;
  }
  return sum.cwiseQuotient(regions);
}

/// A field of the mesh has `columns` values a node.
void Resolver::check_field(const keys::Source& table, const std::string& name,
                           Eigen::Index columns) const {
  check_known(table, "field", name, names_of(names_.mesh.fields));
  const RowMatrix& values = names_.mesh.fields.at(name);
  if (values.rows() != names_.mesh.nodes.rows() || values.cols() != columns)
    table.fail("field", fmt::format("found {} x {} values, expected {} x {}", values.rows(),
                                    values.cols(), names_.mesh.nodes.rows(), columns));
}

/// A rise everywhere or by regions, or temperatures above a reference: of a field of the mesh, a
/// [[heat]], or a table.
void Resolver::finish_temperature(LoadSpec& load) {
  if (std::ranges::none_of(named_materials_,
                           [](const auto& one) { return !one.second.expansion.isZero(0.0); }))
    load.source.fail("kind", "found temperature, no material has an expansion");
  if (!load.rises.empty()) {
    load.node_rises = rise_of_regions(load);
  } else if (!load.heat.empty()) {
    check_known(load.source, "heat", load.heat, names_.heats);
    load.amount = load.reference_temperature;
  } else if (!load.table.empty()) {
    const std::vector<TableColumn> columns = {{"temperature_c", "degrees Celsius", -kZeroCelsius}};
    load.node_rises = values_of_table(load.source, load.table, columns, "").array() + kZeroCelsius -
                      load.reference_temperature;
  } else if (!load.field.empty()) {
    check_field(load.source, load.field, 1);
    load.amount = load.reference;
  } else {
    load.amount = load.value.value_or(1.0);
  }
}

LoadSpec Resolver::load(const recipe::Load& given, size_t) {
  LoadSpec load{given, where(given.source, "load " + given.name)};
  const Source& table = load.source;
  names_.loads.insert(load.name);
  names_.check(table, load.selection);
  load.axes = names_.axes(table, load.system);
  switch (load.kind) {
    case Kind::kPressure:
      if (!load.table.empty())
        load.node_pressures =
            values_of_table(table, load.table, {{"pressure", "Pa"}}, load.selection.surface).col(0);
      break;
    case Kind::kResultant:
      load.force = load.total * *load.direction;
      break;
    case Kind::kForce:
      check_known(table, "set", load.set, names_.sets);
      if (load.force.isZero(0.0) && load.moment.isZero(0.0))
        table.fail("force", "give a force or a moment other than 0");
      break;
    case Kind::kAcceleration:
      if (load.field.empty() && !load.direction)
        table.fail("direction", "is missing, an acceleration needs it, or field");
      load.amount = load.scale;
      if (load.field.empty())
        load.force = *load.direction;
      else
        check_field(table, load.field, 3);
      break;
    case Kind::kCentrifugal:
      for (const std::string& name : load.regions)
        load.rotating.push_back(names_.region(table, "regions", name));
      break;
    case Kind::kDisplacement:
      check_displacement(names_, load);
      load.amount = *load.value;
      break;
    case Kind::kNodal:
      check_field(table, load.field, 3);
      load.amount = load.scale;
      break;
    case Kind::kTemperature:
      finish_temperature(load);
      break;
  }
  if (load.unit.empty()) load.unit = unit_of(load);
  return load;
}

std::map<std::string, double> Resolver::factors(const recipe::Case& sum) const {
  if (names_.loads.contains(sum.name))
    sum.source.fail("name", fmt::format("found \"{}\" twice, expected different names of loads and "
                                        "cases",
                                        sum.name));
  for (const auto& [load, factor] : sum.factors)
    check_known(sum.source.below("loads"), load, load, names_.loads);
  if (sum.factors.empty()) sum.source.fail("loads", "found none, expected at least one");
  return sum.factors;
}

}  // namespace clatter::assembly
