// SPDX-License-Identifier: GPL-3.0-or-later
// [[load]], [[case]].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/keys/member.hpp"
#include "core/recipe/tables.hpp"

namespace clatter::recipe {
namespace {

using Kind = Load::Kind;

/// Whether `value` is a length.
bool is_length(const Load& load) {
  return load.kind == Kind::kDisplacement &&
         std::all_of(load.directions.begin(), load.directions.end(), [](int d) { return d < 3; });
}

/// Names, or a table of rises by name; "" for none.
std::string regions_text(const Load& load) {
  std::vector<std::string> all;
  for (const std::string& name : load.regions) all.push_back(keys::toml_text(name));
  if (!all.empty()) return fmt::format("[{}]", fmt::join(all, ", "));
  for (const auto& [name, rise] : load.rises)
    all.push_back(fmt::format("{} = {}", keys::toml_key(name), rise));
  return all.empty() ? "" : fmt::format("{{ {} }}", fmt::join(all, ", "));
}

}  // namespace

const Keys<Load>& load_keys() {
  static const Keys<Load> keys("load", "a unit load case", [](auto& key, Load& load) {
    key.source(load.source);
    key.name("name", load.name, "name of the load case").required().distinct();
    key.choice("kind", load.kind,
               {{"pressure", Kind::kPressure},
                {"resultant", Kind::kResultant},
                {"force", Kind::kForce},
                {"acceleration", Kind::kAcceleration},
                {"gravity", Kind::kAcceleration},
                {"centrifugal", Kind::kCentrifugal},
                {"displacement", Kind::kDisplacement},
                {"nodal", Kind::kNodal},
                {"temperature", Kind::kTemperature}},
               "1 Pa on a surface, a force spread over it, force and moment on a set, "
               "1 m/s2, 1 rad2/s2 about an axis, a prescribed displacement, forces of a "
               "field of the mesh, or thermal strain")
        .always();
    key.text("surface", load.selection.surface, "a surface of the mesh")
        .needs("kind", {"pressure", "resultant", "displacement"})
        .required_with("kind", {"pressure", "resultant"});
    key.text("node_set", load.selection.node_set, "or a set of nodes of the mesh")
        .needs("kind", "displacement")
        .excludes("surface");
    key.text("point", load.selection.point, "or the name of a [[point]]")
        .needs("kind", "displacement")
        .excludes("surface")
        .excludes("node_set");
    key.direction("direction", load.direction, "direction of the force or acceleration")
        .needs("kind", {"resultant", "acceleration"})
        .required_with("kind", "resultant");
    key.number("total", load.total, {}, "force of one unit")
        .needs("kind", "resultant")
        .shown_in("N");
    key.vector("at", load.at, {}, "a point of the surface around which the force is spread")
        .needs("kind", "resultant")
        .in_length_unit();
    key.number("radius", load.radius, Range::positive(),
               "how far from that point it is spread, most in the middle; over the whole surface "
               "without it")
        .needs("at")
        .required_with("at")
        .in_length_unit();
    key.text("set", load.set, "name of a set or point")
        .needs("kind", "force")
        .required_with("kind", "force");
    key.vector("force", load.force, {}, "force on it").needs("kind", "force").shown_in("N");
    key.vector("moment", load.moment, {}, "moment on it").needs("kind", "force").shown_in("N m");
    key.direction("axis", load.axis.direction, "direction of the axis of rotation")
        .needs("kind", "centrifugal")
        .required_with("kind", "centrifugal");
    key.vector("axis_point", load.axis.point, {}, "a point of the axis")
        .needs("kind", "centrifugal")
        .required_with("kind", "centrifugal")
        .in_length_unit();
    directions(key, load.directions, "directions that are displaced, or in which a point turns")
        .needs("kind", "displacement")
        .required_with("kind", "displacement");
    key.text("system", load.system, "name of a [system] with the directions")
        .needs("kind", "displacement");
    const char* source = "give one source of temperatures";
    key.value(
           "value", load, "a number",
           "the displacement [length_unit] or rotation [rad]; or the rise of all nodes [K], 1 "
           "without it",
           [](const Config& table, const std::string& name, Load& l) {
             l.value = table.number(name) * (is_length(l) ? table.metre() : 1.0);
           },
           [](const keys::Key& row, const Load& l) {
             return l.value ? fmt::format("{}", *l.value / (is_length(l) ? row.unit.scale : 1.0))
                            : "";
           })
        .types({keys::Type::kNumber})
        .in_length_unit()
        .shown_in("")
        .needs("kind", {"displacement", "temperature"})
        .required_with("kind", "displacement");
    key.value(
           "regions", load, "a list of names, or a table of numbers by name",
           "names of those that rotate, all and the point masses without it; or the rise "
           "of each region [K]",
           [](const Config& table, const std::string& name, Load& l) {
             if (table.is_list(name)) {
               l.regions = table.texts(name);
               return;
             }
             const Config rises = table.table(name);
             for (const std::string& one : rises.keys()) l.rises[one] = rises.number(one);
           },
           [](const keys::Key&, const Load& l) { return regions_text(l); })
        .types({keys::Type::kTexts, keys::Type::kByName})
        .needs("kind", {"centrifugal", "temperature"})
        .excludes("value", source);
    key.text("field", load.field,
             "name of a field of the mesh: forces [N], accelerations [m/s2] or temperatures [K]")
        .needs("kind", {"nodal", "acceleration", "temperature"})
        .excludes("direction", "a field has its directions")
        .required_with("kind", "nodal")
        .excludes("value", source)
        .excludes("regions", source);
    key.text("heat", load.heat, "name of a [[heat]] with the temperatures")
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
    key.number("reference_c", load.reference_temperature, {-273.15},
               "temperature without strain, of heat and table")
        .needs("kind", "temperature");
    key.number("reference", load.reference, {}, "temperature of a field without strain")
        .shown_in("K")
        .needs("field");
    key.number("scale", load.scale, {}, "factor of the forces or accelerations of the field")
        .needs("kind", {"nodal", "acceleration"})
        .needs("field");
    key.text("unit", load.unit, "unit of the load case, in lists of results");
  });
  return keys;
}

const Keys<Case>& case_keys() {
  static const Keys<Case> keys("case", "a sum of loads", [](auto& key, Case& sum) {
    key.source(sum.source);
    key.name("name", sum.name, "name of the load case").required().distinct();
    key.by_name("loads", sum.factors, {}, "factor of each load").required();
  });
  return keys;
}

}  // namespace clatter::recipe
