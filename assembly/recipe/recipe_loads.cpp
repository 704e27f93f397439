// SPDX-License-Identifier: GPL-3.0-or-later
// [[load]], [[case]].
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "assembly/recipe/recipe_keys.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"

namespace clatter::assembly {
namespace {

using Kind = LoadSpec::Kind;

void finish_displacement(const Config& table, LoadTable& load) {
  LoadSpec& spec = load.spec;
  check_directions(table, spec.selection, spec.directions);
  const bool turns = spec.directions.back() >= 3;
  for (const int d : spec.directions)
    if ((d >= 3) != turns)
      table.fail("directions",
                 "displacements and rotations exclude each other: value is a length or an angle");
  spec.value = (turns ? 1.0 : table.metre()) * *load.value;
}

/// The unit of a load case that names none.
std::string unit_of(const LoadSpec& spec) {
  switch (spec.kind) {
    case Kind::kPressure:
      return spec.pressure.size() > 0 ? "1" : "Pa";
    case Kind::kResultant:
      return "N";
    case Kind::kGravity:
      return "m/s2";
    case Kind::kCentrifugal:
      return "rad2/s2";
    default:
      return "1";
  }
}

}  // namespace

RowMatrix RecipeKeys::values_of_table(const Config& table, const std::filesystem::path& path,
                                      const std::vector<TableColumn>& columns,
                                      const std::string& on) {
  constexpr double kCoarse = 0.05;  // of the table's range: an error of 5 % of the load's variation
  constexpr double kConstant = 1e-9;  // of its values: a smaller range is rounding
  const mesh::Mesh& mesh = names_.mesh;
  files_.push_back(path);
  const PointTable points = read_point_table(path, table.metre(), columns);
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
Eigen::VectorXd RecipeKeys::rise_of_regions(const Config& table, const LoadTable& load) const {
  std::vector<double> rise(names_.mesh.regions.size(), 0.0);
  for (const auto& [name, value] : load.rises)
    rise[names_.region(table.table("regions"), name, name)] = value;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(names_.mesh.nodes.rows()), regions = sum;
  for (size_t r = 0; r < rise.size(); ++r) {
    std::vector<bool> inside(static_cast<size_t>(sum.size()), false);
    for (const mesh::CellBlock& block : names_.mesh.cells)
      if (static_cast<size_t>(block.region) == r)
        for (const int32_t node : block.nodes.reshaped()) inside[node] = true;
    for (Eigen::Index a = 0; a < sum.size(); ++a)
      if (inside[a]) sum(a) += rise[r], regions(a) += 1.0;
  }
  return sum.cwiseQuotient(regions);
}

/// A field of the mesh has `columns` values a node.
void RecipeKeys::check_field(const Config& table, const std::string& name,
                             Eigen::Index columns) const {
  check_known(table, "field", name, names_of(names_.mesh.fields));
  const RowMatrix& values = names_.mesh.fields.at(name);
  if (values.rows() != names_.mesh.nodes.rows() || values.cols() != columns)
    table.fail("field", fmt::format("found {} x {} values, expected {} x {}", values.rows(),
                                    values.cols(), names_.mesh.nodes.rows(), columns));
}

/// A rise everywhere or by regions, or temperatures above a reference: of a field of the mesh, a
/// [[heat]], or a table.
void RecipeKeys::finish_temperature(const Config& table, LoadTable& load) {
  LoadSpec& spec = load.spec;
  if (std::none_of(materials_.begin(), materials_.end(),
                   [](const fe::Material& one) { return !one.expansion.isZero(0.0); }))
    table.fail("kind", "found temperature, no material has an expansion");
  if (!load.rises.empty()) {
    spec.rise = rise_of_regions(table, load);
  } else if (!spec.heat.empty()) {
    check_known(table, "heat", spec.heat, names_.heats);
    spec.value = load.reference_temperature;
  } else if (!load.table.empty()) {
    const std::vector<TableColumn> columns = {{"temperature_c", "degrees Celsius", -kZeroCelsius}};
    spec.rise = values_of_table(table, load.table, columns, "").array() + kZeroCelsius -
                load.reference_temperature;
  } else if (!spec.field.empty()) {
    check_field(table, spec.field, 1);
    spec.value = load.reference;
  } else {
    spec.value = load.value.value_or(1.0);
    if (spec.unit.empty() && spec.value == 1.0) spec.unit = "K";
  }
}

void RecipeKeys::finish_load(const Config& table, LoadTable& load) {
  LoadSpec& spec = load.spec;
  spec.where = where(table, "load " + spec.name);
  names_.loads.insert(spec.name);
  names_.check(table, "load " + spec.name, spec.selection);
  switch (spec.kind) {
    case Kind::kPressure:
      spec.surface = spec.selection.surface;
      if (!load.table.empty())
        spec.pressure =
            values_of_table(table, load.table, {{"pressure", "Pa"}}, spec.surface).col(0);
      break;
    case Kind::kResultant:
      spec.surface = spec.selection.surface;
      spec.force = load.total * *load.direction;
      break;
    case Kind::kForce:
      check_known(table, "set", spec.set, names_.sets);
      if (spec.force.isZero(0.0) && spec.moment.isZero(0.0))
        table.fail("force", "give a force or a moment other than 0");
      break;
    case Kind::kGravity:
      if (!spec.field.empty()) {
        spec.kind = Kind::kAcceleration;
        check_field(table, spec.field, 3);
        spec.value = load.scale;
      } else if (load.direction) {
        spec.force = *load.direction;
      } else {
        table.fail("direction", "is missing, an acceleration needs it, or field");
      }
      break;
    case Kind::kAcceleration:  // of no name: what kGravity with a field becomes
      break;
    case Kind::kCentrifugal:
      for (const std::string& name : load.regions)
        spec.rotating.push_back(names_.region(table, "regions", name));
      break;
    case Kind::kDisplacement:
      if (spec.selection.surface.empty() && spec.selection.node_set.empty() &&
          spec.selection.point.empty())
        table.fail("surface", "give surface, node_set or point");
      finish_displacement(table, load);
      spec.axes = names_.axes(table, load.system);
      break;
    case Kind::kNodal:
      check_field(table, spec.field, 3);
      spec.value = load.scale;
      break;
    case Kind::kTemperature:
      finish_temperature(table, load);
      break;
  }
  if (spec.unit.empty()) spec.unit = unit_of(spec);
}

const keys::Keys<LoadTable>& RecipeKeys::load_keys() {
  const auto rows = [this](auto& key, LoadTable& load) {
    LoadSpec& spec = load.spec;
    key.name("name", spec.name, "name of the load case").required().distinct();
    key.choice("kind", spec.kind,
               {{"pressure", Kind::kPressure},
                {"resultant", Kind::kResultant},
                {"force", Kind::kForce},
                {"gravity", Kind::kGravity},
                {"acceleration", Kind::kGravity},
                {"centrifugal", Kind::kCentrifugal},
                {"displacement", Kind::kDisplacement},
                {"nodal", Kind::kNodal},
                {"temperature", Kind::kTemperature}},
               "1 Pa on a surface, a force spread over it, force and moment on a set, "
               "1 m/s2, 1 rad2/s2 about an axis, a prescribed displacement, forces of a "
               "field of the mesh, or thermal strain");
    key.text("surface", spec.selection.surface, "a surface of the mesh")
        .needs("kind", {"pressure", "resultant", "displacement"})
        .required_with("kind", {"pressure", "resultant"});
    key.text("node_set", spec.selection.node_set, "or a set of nodes of the mesh")
        .needs("kind", "displacement")
        .excludes("surface");
    key.text("point", spec.selection.point, "or the name of a [[point]]")
        .needs("kind", "displacement")
        .excludes("surface")
        .excludes("node_set");
    key.direction("direction", load.direction, "direction of the force or acceleration")
        .needs("kind", {"resultant", "gravity"})
        .required_with("kind", "resultant");
    key.number("total", load.total, {}, "force of one unit")
        .needs("kind", "resultant")
        .shown_in("N");
    key.text("set", spec.set, "name of a set or point")
        .needs("kind", "force")
        .required_with("kind", "force");
    key.vector("force", spec.force, {}, "force on it").needs("kind", "force").shown_in("N");
    key.vector("moment", spec.moment, {}, "moment on it").needs("kind", "force").shown_in("N m");
    key.direction("axis", spec.axis.direction, "direction of the axis of rotation")
        .needs("kind", "centrifugal")
        .required_with("kind", "centrifugal");
    key.vector("axis_point", spec.axis.point, {}, "a point of the axis")
        .needs("kind", "centrifugal")
        .required_with("kind", "centrifugal")
        .in_length_unit();
    directions(key, spec.directions, "directions that are displaced, or in which a point turns")
        .needs("kind", "displacement")
        .required_with("kind", "displacement");
    key.text("system", load.system, "name of a [system] with the directions")
        .needs("kind", "displacement");
    const char* source = "give one source of temperatures";
    key.number("value", load.value, {},
               "the displacement [length_unit] or rotation [rad]; or the rise of all nodes "
               "[K], 1 without it")
        .needs("kind", {"displacement", "temperature"})
        .required_with("kind", "displacement");
    key.value("regions", load, "a list of names, or a table of numbers by name",
              "names of those that rotate, all and the point masses without it; or the rise "
              "of each region [K]",
              [](const Config& table, const std::string& name, LoadTable& l) {
                if (table.is_list(name)) {
                  l.regions = table.texts(name);
                  return;
                }
                const Config rises = table.table(name);
                for (const std::string& one : rises.keys()) l.rises[one] = rises.number(one);
              })
        .types({keys::Type::kTexts, keys::Type::kByName})
        .needs("kind", {"centrifugal", "temperature"})
        .excludes("value", source);
    key.text("field", spec.field,
             "name of a field of the mesh: forces [N], accelerations [m/s2] or temperatures [K]")
        .needs("kind", {"nodal", "gravity", "temperature"})
        .excludes("direction", "a field has its directions")
        .required_with("kind", "nodal")
        .excludes("value", source)
        .excludes("regions", source);
    key.text("heat", spec.heat, "name of a [[heat]] with the temperatures")
        .needs("kind", "temperature")
        .excludes("value", source)
        .excludes("regions", source)
        .excludes("field", source);
    key.path("table", load.table,
             "CSV file of points with the column temperature_c, or pressure [Pa]; interpolated")
        .needs("kind", {"pressure", "temperature"})
        .excludes("value", source)
        .excludes("regions", source)
        .excludes("field", source)
        .excludes("heat", source);
    key.number("reference_c", load.reference_temperature, {-kZeroCelsius},
               "temperature without strain, of heat and table")
        .needs("kind", "temperature");
    key.number("reference", load.reference, {}, "temperature of a field without strain")
        .shown_in("K")
        .needs("field");
    key.number("scale", load.scale, {}, "factor of the forces or accelerations of the field")
        .needs("kind", {"nodal", "gravity"})
        .needs("field");
    key.text("unit", spec.unit, "unit of the load case, in lists of results");
    key.check([this](const Config& table, LoadTable& l) { finish_load(table, l); });
  };
  return keep<LoadTable>("load", "a unit load case", rows);
}

const keys::Keys<CaseTable>& RecipeKeys::case_keys() {
  const auto rows = [this](auto& key, CaseTable& table) {
    key.name("name", table.name, "name of the load case").required().distinct();
    key.by_name("loads", table.factors, {}, "factor of each load").required();
    key.check([this](const Config& config, CaseTable& c) {
      if (names_.loads.contains(c.name))
        config.fail("name", fmt::format("found \"{}\" twice, expected different names of "
                                        "loads and cases",
                                        c.name));
      for (const auto& [load, factor] : c.factors)
        check_known(config.table("loads"), load, load, names_.loads);
      if (c.factors.empty()) config.fail("loads", "found none, expected at least one");
    });
  };
  return keep<CaseTable>("case", "a sum of loads", rows);
}

}  // namespace clatter::assembly
