// SPDX-License-Identifier: GPL-3.0-or-later
// [[point]], [[support]], [[coupling]], [[equation]], [[spring]], [[matrix]], [[straight_edges]],
// [[tie]], [[bolt]].
#include <fmt/format.h>

#include <algorithm>

#include "assembly/recipe/resolve.hpp"

namespace clatter::assembly {

PointSpec Resolver::point(const recipe::Point& point, size_t) {
  names_.add_set(point.source, point.name);
  names_.points.insert(point.name);
  PointSpec spec{{.name = point.name}, point.number, where(point.source, "point " + point.name)};
  if (point.node_set.empty()) {
    spec.point.position = *point.at;
    return spec;
  }
  const int32_t node = names_.only_node(point.source, point.node_set);
  spec.point.node = node;
  spec.point.position = names_.mesh.nodes.row(node).transpose();
  if (!names_.mesh.node_ids.empty()) spec.number = names_.mesh.node_ids[node];
  return spec;
}

SupportSpec Resolver::support(const recipe::Support& support, size_t number) {
  SupportSpec spec{support, {}, {}};
  if (spec.name.empty()) spec.name = fmt::format("support_{}", number);
  spec.where = where(support.source, "support " + spec.name);
  names_.check(support.source, support.selection);
  names_.check_directions(support.source, "directions", support.selection, support.directions);
  spec.axes = names_.axes(support.source, support.system);
  return spec;
}

std::vector<TermSpec> Resolver::terms_of(const Source& table, const std::string& what,
                                         const recipe::Members& own,
                                         const std::vector<recipe::Members>& given,
                                         const std::vector<int>& all) const {
  std::vector<TermSpec> terms;
  const auto add = [&](const Source& source, const recipe::Members& members) {
    TermSpec term{names_.selection(source, what, members.selection), members.weight,
                  members.directions.empty() ? all : members.directions,
                  names_.axes(source, members.system)};
    if (!term.selection.surface.empty() || !term.selection.node_set.empty()) terms.push_back(term);
    for (const std::string& name : members.points) {
      check_known(source, "points", name, names_.points);
      term.selection = Selection{{.point = name}, term.selection.where};
      terms.push_back(term);
    }
  };
  add(table, own);
  for (const recipe::Members& members : given) {
    const Source& source = members.source.where().empty() ? table : members.source;
    const size_t before = terms.size();
    add(source, members);
    if (terms.size() == before) source.fail("surface", "give surface, node_set or points");
  }
  return terms;
}

CouplingSpec Resolver::coupling(const recipe::Coupling& coupling, size_t) {
  const Source& table = coupling.source;
  CouplingSpec spec{.name = coupling.name,
                    .kind = coupling.kind,
                    .where = {},
                    .rigid = coupling.rigid,
                    .at = coupling.at,
                    .on_point = coupling.on_point,
                    .terms = {},
                    .directions = coupling.directions};
  if (spec.on_point.empty()) {
    if (spec.name.empty())
      table.fail("name", "is missing, a coupling without a [[point]] needs it");
    names_.add_set(table, spec.name);
  } else {
    check_known(table, "point", spec.on_point, names_.points);
    if (spec.name.empty()) spec.name = "on " + spec.on_point;
    spec.kind.clear();
  }
  std::sort(spec.directions.begin(), spec.directions.end());
  const std::string what = "coupling " + spec.name;
  spec.where = where(table, what);
  spec.terms = terms_of(table, what, coupling.members, coupling.terms, {0, 1, 2});
  if (spec.terms.empty()) table.fail("surface", "give surface, node_set, points or terms");
  return spec;
}

namespace {

const keys::Source& source_of(const recipe::Term& term, const keys::Source& table) {
  return term.source.where().empty() ? table : term.source;
}

}  // namespace

std::vector<EquationSpec::Term> Resolver::terms_of(const Source& table, const std::string& what,
                                                   const std::vector<recipe::Term>& given) const {
  std::vector<EquationSpec::Term> terms;
  for (const recipe::Term& term : given) {
    const Source& source = source_of(term, table);
    terms.push_back({names_.selection(source, what, term.selection), term.direction,
                     term.coefficient.value_or(1.0)});
    if (!term.selection.point.empty()) continue;
    names_.only_node(source, term.selection.node_set);
    names_.check_directions(source, "direction", term.selection, {term.direction});
  }
  return terms;
}

EquationSpec Resolver::equation(const recipe::Equation& equation, size_t number) {
  const std::string what = fmt::format("equation {}", number);
  const Source& table = equation.source;
  EquationSpec spec{where(table, what), terms_of(table, what, equation.terms)};
  for (const recipe::Term& term : equation.terms)
    if (!term.coefficient)
      source_of(term, table).fail("coefficient", "found nothing, expected a number");
  if (spec.terms.empty() || spec.terms[0].coefficient == 0.0)
    table.fail("terms",
               "found none, or a first coefficient of zero, expected a dependent term first");
  return spec;
}

/// Rotations beside displacements have a lever arm.
SpringSpec Resolver::spring(const recipe::Spring& spring, size_t number) {
  const Source& table = spring.source;
  const std::string name = spring.name.empty() ? fmt::format("spring_{}", number) : spring.name;
  SpringSpec spec{name, where(table, "spring " + name), spring.stiffness,
                  terms_of(table, "spring " + name, spring.terms), spring.loss_factor};
  for (const recipe::Term& term : spring.terms) {
    const Source& source = source_of(term, table);
    if (term.coefficient == 0.0) source.fail("coefficient", "found 0, expected a nonzero number");
    if (term.direction / 3 != spring.terms[0].direction / 3 && !term.coefficient)
      source.fail("coefficient",
                  "found none at a rotation beside a displacement, expected a lever arm [m]");
  }
  if (spec.terms.empty()) table.fail("terms", "found none, expected one (to the ground) or more");
  return spec;
}

MatrixSpec Resolver::matrix(const recipe::Matrix& matrix, size_t number) {
  const std::string name = matrix.name.empty() ? fmt::format("matrix_{}", number) : matrix.name;
  const bool is_mass = !matrix.M.empty();
  const std::vector<double>& lower = is_mass ? matrix.M : matrix.K;
  const auto n = static_cast<Eigen::Index>(matrix.terms.size());
  if (n == 0 || static_cast<Eigen::Index>(lower.size()) != n * (n + 1) / 2)
    matrix.source.fail(is_mass ? "M" : "K",
                       fmt::format("found {} numbers for {} terms, expected {}: the lower "
                                   "triangle row by row",
                                   lower.size(), n, n * (n + 1) / 2));
  MatrixSpec spec{name,
                  where(matrix.source, "matrix " + name),
                  is_mass,
                  terms_of(matrix.source, "matrix " + name, matrix.terms),
                  Eigen::MatrixXd(n, n),
                  matrix.loss_factor};
  size_t at = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) spec.values(i, j) = spec.values(j, i) = lower[at++];
  return spec;
}

StraightEdgesSpec Resolver::straight_edges(const recipe::StraightEdges& edges, size_t) {
  names_.check_node_set(edges.source, edges.node_set);
  return {edges, where(edges.source, "straight edges " + edges.node_set)};
}

/// @param kind of the table, for messages.
TieSpec Resolver::tied(const recipe::Tie& tie, const std::string& name, const char* kind) {
  TieSpec spec{tie, false, where(tie.source, fmt::format("{} {}", kind, name))};
  spec.name = name;
  if (tie.edge.empty())
    names_.check_surface(tie.source, tie.slave, "slave");
  else
    names_.check_node_set(tie.source, tie.edge, "edge");
  names_.check_surface(tie.source, tie.master, "master");
  if (tie.slave == tie.master)
    tie.source.fail("master", "found the slave surface, expected another one");
  return spec;
}

TieSpec Resolver::tie(const recipe::Tie& tie, size_t number) {
  const std::string name = tie.name.empty() ? fmt::format("tie_{}", number) : tie.name;
  names_.ties.insert(name);
  return tied(tie, name, "tie");
}

TieSpec Resolver::bolt(const recipe::Tie& bolt, size_t) {
  names_.add_set(bolt.source, bolt.name);
  names_.ties.insert(bolt.name);
  TieSpec spec = tied(bolt, bolt.name, "bolt");
  spec.bolt = true;
  return spec;
}

GasketSpec Resolver::gasket(const recipe::Gasket& gasket, size_t number) {
  const std::string name = gasket.name.empty() ? fmt::format("gasket_{}", number) : gasket.name;
  if (!names_.gaskets.insert(name).second)
    gasket.source.fail("name", fmt::format("found \"{}\" twice, expected different names", name));
  if (gasket.normal == 0.0 && gasket.tangential == 0.0)
    gasket.source.fail("normal_stiffness", "found 0 for both stiffnesses, expected one above");
  GasketSpec spec{tied(gasket, name, "gasket"),
                  gasket.normal,
                  gasket.tangential,
                  gasket.loss_factor,
                  {gasket.closure, gasket.pressure}};
  if (!gasket.pressed.empty()) {
    spec.pressed = fe::read_pressed(gasket.pressed, gasket.pressed_case, name);
    files_.push_back(gasket.pressed);
  }
  return spec;
}

}  // namespace clatter::assembly
