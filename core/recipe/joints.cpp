// SPDX-License-Identifier: GPL-3.0-or-later
// [[point]], [[support]], [[coupling]], [[equation]], [[spring]], [[matrix]], [[straight_edges]],
// [[tie]], [[bolt]].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/keys/member.hpp"
#include "core/recipe/tables.hpp"

namespace clatter::recipe {

std::vector<int> read_directions(const Config& table, const std::string& key) {
  std::vector<std::string> names;
  if (table.is_list(key))
    names = table.texts(key);
  else
    for (const char axis : table.text(key)) names.emplace_back(1, axis);
  std::vector<int> found;
  for (const std::string& name : names) {
    const auto* const at = std::find(fe::kDofNames.begin(), fe::kDofNames.end(), name);
    const auto d = static_cast<int>(at - fe::kDofNames.begin());
    if (at == fe::kDofNames.end() || std::find(found.begin(), found.end(), d) != found.end())
      table.fail(key, fmt::format("found \"{}\", expected each of {} at most once",
                                  fmt::join(names, " "), fmt::join(fe::kDofNames, " ")));
    found.push_back(d);
  }
  if (found.empty()) table.fail(key, "found none, expected at least one direction");
  return found;
}

std::string directions_text(const std::vector<int>& directions) {
  std::vector<const char*> names;
  for (const int d : directions) names.push_back(fe::kDofNames[d]);
  return names.empty() ? "" : fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

const Keys<Point>& point_keys() {
  static const Keys<Point> keys(
      "point", "a reference node with six DoFs of its own", [](auto& key, Point& point) {
        key.source(point.source);
        key.name("name", point.name, "name of the point and its set").required();
        key.text("node_set", point.node_set, "a set of one node of the mesh, where it is");
        key.vector("at", point.at, {}, "its position").in_length_unit();
        key.integer("number", point.number, {1.0, std::numeric_limits<int32_t>::max()},
                    "number of its node in the deck of the mesh, for exports")
            .needs("at");
        key.one_of({"node_set", "at"});
      });
  return keys;
}

const Keys<Support>& support_keys() {
  static const Keys<Support> keys(
      "support", "displacements held at zero, or at the values of a load",
      [](auto& key, Support& support) {
        key.source(support.source);
        key.text("name", support.name, "name for messages; support_1, support_2, ... without it")
            .distinct();
        select_by(key, support.selection, {"surface", "node_set", "point"});
        directions(key, support.directions, "directions that are held; x, y and z without it");
        key.text("system", support.system, "name of a [system] with the directions");
      });
  return keys;
}

const Keys<Members>& member_keys(bool turned) {
  const auto make = [](bool with_system) {
    return Keys<Members>("term", "some of the nodes and points, with their weight and directions",
                         [with_system](auto& key, Members& members) {
                           key.source(members.source);
                           member_rows(key, members);
                           if (with_system) system_row(key, members);
                           key.number("weight", members.weight, Range::positive(),
                                      "weight of each node; on a surface of each area");
                           directions(key, members.directions,
                                      "directions that count; those of the table above without it");
                         });
  };
  static const Keys<Members> plain = make(false), with_system = make(true);
  return turned ? with_system : plain;
}

const Keys<Coupling>& coupling_keys() {
  static const Keys<Coupling> keys(
      "coupling",
      "a reference node that follows a surface or nodes (distributing, RBE3), or that they "
      "follow (rigid, RBE2)",
      [](auto& key, Coupling& coupling) {
        key.source(coupling.source);
        key.name("name", coupling.name, "name of its set; not needed on a [[point]]");
        key.choice("kind", coupling.kind, {"node", "bearing", "mount"}, "kind of its set");
        key.value(
               "point", coupling, "three coordinates or a name",
               "position of the reference node [length_unit], or the name of a [[point]] that is "
               "it; the "
               "surface's centroid without it",
               [](const Config& table, const std::string& name, Coupling& c) {
                 if (!table.is_list(name))
                   c.on_point = table.text(name);
                 else
                   c.at = table.metre() * Eigen::Vector3d(table.numbers(name, 3).data());
               },
               [](const keys::Key& row, const Coupling& c) -> std::string {
                 if (!c.on_point.empty()) return keys::toml_text(c.on_point);
                 if (!c.at) return "";
                 const Eigen::Vector3d at = *c.at / row.unit.scale;
                 return fmt::format("[{}]", fmt::join(at, ", "));
               })
            .types({keys::Type::kText, keys::Type::kNumbers})
            .in_length_unit()
            .shown_in("");
        key.choice("type", coupling.rigid, {{"distributing", false}, {"rigid", true}},
                   "whether the reference follows a surface or nodes, or these follow it");
        member_rows(key, coupling.members);
        key.tables("term", coupling.terms, member_keys(false))
            .needs("type", "distributing", "followers have no weights");
        directions(key, coupling.directions,
                   "directions of the reference node, of a rigid coupling those of the followers; "
                   "all without it");
        key.integer("dofs", coupling.dofs, {3, 6},
                    "6 or 3: of the reference node, as directions = \"xyz\"")
            .needs("type", "distributing")
            .excludes("directions");
        key.check([](const Config& table, Coupling& c) {
          if (!c.on_point.empty() && table.has("kind"))
            table.fail("kind", "is that of the [[point]]: leave it out");
          if (c.dofs && *c.dofs != 3 && *c.dofs != 6)
            table.fail("dofs", fmt::format("found {}, expected 6 or 3", *c.dofs));
          if (c.dofs == 3) c.directions = {0, 1, 2};
          c.dofs.reset();
        });
      });
  return keys;
}

namespace {

const Keys<Term>& term_keys() {
  static const Keys<Term> keys(
      "terms", "one direction of one node or point", [](auto& key, Term& term) {
        key.source(term.source);
        select_by(key, term.selection, {"node_set", "point"});
        key.choice("direction", term.direction,
                   {{"x", 0}, {"y", 1}, {"z", 2}, {"rx", 3}, {"ry", 4}, {"rz", 5}},
                   "direction of the displacement or rotation")
            .required();
        key.number("coefficient", term.coefficient, {},
                   "coefficient in the sum; 1 of springs without it, and a lever arm [m] at a "
                   "rotation beside displacements");
      });
  return keys;
}

/// The rows that ties, bolts and gaskets have.
template <class Rows>
void surface_rows(Rows& key, Tie& tie, bool needs_slave) {
  keys::Row slave = key.text("slave", tie.slave, "a surface of the mesh, which follows");
  if (needs_slave) slave.required();
  key.text("master", tie.master, "a surface of the mesh").required();
  key.number("distance", tie.distance, Range::not_negative(),
             "largest gap; a tenth of the mean slave face's size, or half the thickness of the "
             "sheet whose edge it is, without it")
      .in_length_unit();
}

template <class Rows>
auto loss_row(Rows& key, double& loss_factor) {
  return key.number("loss_factor", loss_factor, Range::between(0.0, 10.0),
                    "share of its energy that a cycle loses, over 2 pi");
}

}  // namespace

const Keys<Equation>& equation_keys() {
  static const Keys<Equation> keys(
      "equation", "a sum of displacements that is zero; the first depends on the others",
      [](auto& key, Equation& equation) {
        key.source(equation.source);
        key.tables("terms", equation.terms, term_keys()).required().one_line();
      });
  return keys;
}

const Keys<Spring>& spring_keys() {
  static const Keys<Spring> keys(
      "spring", "a stiffness of a sum of displacements, one to the ground or several",
      [](auto& key, Spring& spring) {
        key.source(spring.source);
        key.text("name", spring.name, "name for messages; spring_1, spring_2, ... without it");
        key.number("stiffness", spring.stiffness, Range::positive(),
                   "force over the sum; moment over it where all are rotations [N m/rad]")
            .required()
            .shown_in("N/m");
        loss_row(key, spring.loss_factor);
        key.tables("terms", spring.terms, term_keys()).required().one_line();
      });
  return keys;
}

const Keys<Matrix>& matrix_keys() {
  static const Keys<Matrix> keys(
      "matrix", "stiffness or mass between DoFs, beside the cells", [](auto& key, Matrix& matrix) {
        key.source(matrix.source);
        key.text("name", matrix.name, "name for messages; matrix_1, matrix_2, ... without it");
        key.tables("terms", matrix.terms, term_keys(),
                   "its rows, one direction of one node or point each")
            .required()
            .one_line();
        key.numbers("K", matrix.K, {}, "stiffness: the lower triangle, row by row [N/m, N, N m]")
            .triangle();
        key.numbers("M", matrix.M, {}, "mass: the lower triangle, row by row [kg, kg m, kg m2]")
            .triangle();
        key.one_of({"K", "M"});
        loss_row(key, matrix.loss_factor).needs("K");
      });
  return keys;
}

const Keys<StraightEdges>& straight_edges_keys() {
  static const Keys<StraightEdges> keys(
      "straight_edges", "mid-side nodes that move with the mean of the two ends of their edge",
      [](auto& key, StraightEdges& edges) {
        key.source(edges.source);
        key.text("node_set", edges.node_set, "a set of mid-side nodes of the mesh").required();
      });
  return keys;
}

const Keys<Tie>& tie_keys() {
  static const Keys<Tie> keys(
      "tie", "a slave surface, or the edge of a sheet, that follows a master surface",
      [](auto& key, Tie& tie) {
        key.source(tie.source);
        key.text("name", tie.name, "name for messages and heat");
        surface_rows(key, tie, false);
        key.text("edge", tie.edge,
                 "in place of slave: a node set with the edge of a sheet "
                 "that stands on the master");
        key.one_of({"slave", "edge"});
      });
  return keys;
}

const Keys<Tie>& bolt_keys() {
  static const Keys<Tie> keys(
      "bolt", "a cut shank: a tie with one free relative displacement, its tension",
      [](auto& key, Tie& bolt) {
        key.source(bolt.source);
        key.text("name", bolt.name, "name of its set").required();
        surface_rows(key, bolt, true);
        key.direction("direction", bolt.direction, "direction from slave to master").required();
      });
  return keys;
}

namespace {

/// A curve has two points or more, which ascend from pressure 0.
void check_curve(const Config& table, const Gasket& gasket) {
  const auto ascends = [](const std::vector<double>& values, auto order) {
    return std::ranges::adjacent_find(values, order) == values.end();
  };
  const size_t count = gasket.closure.size();
  if (gasket.pressure.size() != count)
    table.fail("pressure_mpa",
               fmt::format("found {} numbers for {} of closure_um, expected as many",
                           gasket.pressure.size(), count));
  if (count == 0) return;
  if (count == 1 || !ascends(gasket.closure, std::greater_equal()))
    table.fail("closure_um", "found closures that do not ascend, expected two or more that do");
  if (gasket.pressure[0] != 0.0 || !ascends(gasket.pressure, std::greater()))
    table.fail("pressure_mpa",
               "found pressures that do not ascend from 0, expected 0 and then higher ones");
  if (gasket.pressure[count - 1] == gasket.pressure[count - 2])
    table.fail("pressure_mpa",
               "found the last two equal, expected a rise: the curve goes on with its last slope");
}

}  // namespace

const Keys<Gasket>& gasket_keys() {
  static const Keys<Gasket> keys(
      "gasket", "an elastic layer between a slave and a master surface",
      [](auto& key, Gasket& gasket) {
        key.source(gasket.source);
        key.name("name", gasket.name, "name of the gasket; gasket_1, gasket_2, ... without it")
            .distinct();
        surface_rows(key, gasket, true);
        key.number("normal_stiffness", gasket.normal, Range::not_negative(),
                   "pressure over the closing of the gap; of a curve its slope when it is unloaded "
                   "from the pressure of the assembly")
            .required()
            .shown_in("N/m3");
        key.number("tangential_stiffness", gasket.tangential, Range::not_negative(),
                   "shear stress over the sliding: shear modulus over thickness")
            .required()
            .shown_in("N/m3");
        loss_row(key, gasket.loss_factor);
        key.numbers("closure_um", gasket.closure, {},
                    "curve of loading, which clatter-modal statics follows in place of "
                    "normal_stiffness: ascending closures, the first one where it begins to carry; "
                    "below it is open and does not pull")
            .needs("pressure_mpa");
        key.numbers("pressure_mpa", gasket.pressure, Range::not_negative(),
                    "pressure at each of these closures, 0 at the first; beyond the last one it "
                    "goes on with the last slope")
            .needs("closure_um");
        key.path("pressed", gasket.pressed,
                 "static results (.static.h5) of a model in which the gasket of this name has a "
                 "curve: the stiffnesses are those of its pressed points, and 0 where it is open")
            .excludes("closure_um", "the curve has been followed");
        key.text("pressed_case", gasket.pressed_case,
                 "case of these results; needed where they have several")
            .needs("pressed");
        key.check([](const Config& table, Gasket& gasket) { check_curve(table, gasket); });
      });
  return keys;
}

}  // namespace clatter::recipe
