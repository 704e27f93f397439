// SPDX-License-Identifier: GPL-3.0-or-later
// [[point]], [[support]], [[coupling]], [[equation]], [[spring]], [[matrix]], [[straight_edges]],
// [[tie]], [[bolt]].
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "assembly/recipe/recipe_keys.hpp"

namespace clatter::assembly {

using keys::Type;

const keys::Keys<PointSpec>& RecipeKeys::point_keys() {
  const auto rows = [this](auto& key, PointSpec& point) {
    key.name("name", point.point.name, "name of the point and its set").required();
    key.text("node_set", point.node_set, "a set of one node of the mesh, where it is");
    key.vector("at", point.point.position, {}, "its position").in_length_unit();
    key.integer("number", point.number, {1.0, std::numeric_limits<int32_t>::max()},
                "number of its node in the deck of the mesh, for exports")
        .needs("at");
    key.one_of({"node_set", "at"});
    key.check([this](const Config& table, PointSpec& p) {
      names_.add_set(table, p.point.name);
      names_.points.insert(p.point.name);
      p.where = where(table, "point " + p.point.name);
      if (p.node_set.empty()) return;
      names_.check_node_set(table, p.node_set);
      const std::vector<int32_t>& nodes = names_.mesh.node_set(p.node_set);
      if (nodes.size() != 1)
        table.fail("node_set", fmt::format("found {} nodes, expected one", nodes.size()));
      p.point.node = nodes[0];
      p.point.position = names_.mesh.nodes.row(nodes[0]).transpose();
      if (!names_.mesh.node_ids.empty()) p.number = names_.mesh.node_ids[nodes[0]];
    });
  };
  return keep<PointSpec>("point", "a reference node with six DoFs of its own", rows);
}

const keys::Keys<SupportSpec>& RecipeKeys::support_keys() {
  const auto rows = [this](auto& key, SupportSpec& support) {
    key.text("name", support.name, "name for messages; support_1, support_2, ... without it")
        .distinct();
    select_by(key, support.selection, {"surface", "node_set", "point"});
    directions(key, support.directions, "directions that are held; x, y and z without it");
    key.text("system", support.system, "name of a [system] with the directions");
    key.check([this](const Config& table, SupportSpec& s) {
      const int number = next("support");
      if (s.name.empty()) s.name = fmt::format("support_{}", number);
      names_.check(table, "support " + s.name, s.selection);
      check_directions(table, s.selection, s.directions);
      s.axes = names_.axes(table, s.system);
    });
  };
  return keep<SupportSpec>("support", "displacements held at zero, or at the values of a load",
                           rows);
}

const keys::Keys<MemberTable>& RecipeKeys::member_keys(bool turned) {
  const auto rows = [this, turned](auto& key, MemberTable& members) {
    member_rows(key, members);
    if (turned) system_row(key, members);
    key.number("weight", members.weight, Range::positive(),
               "weight of each node; on a surface of each area");
    directions(key, members.directions,
               "directions that count; those of the table above without it");
    key.check([this](const Config& table, MemberTable& m) {
      check_members(table, m);
      if (m.selection.surface.empty() && m.selection.node_set.empty() && m.points.empty())
        table.fail("surface", "give surface, node_set or points");
    });
  };
  return keep<MemberTable>("term", "some of the nodes and points, with their weight and directions",
                           rows);
}

void RecipeKeys::check_members(const Config& table, MemberTable& members) const {
  names_.check(table, "", members.selection);
  members.axes = names_.axes(table, members.system);
  for (const std::string& name : members.points) check_known(table, "points", name, names_.points);
}

std::vector<TermSpec> RecipeKeys::terms_of(const std::string& what, const MemberTable& own,
                                           const std::vector<MemberTable>& given,
                                           const std::vector<int>& all) {
  std::vector<TermSpec> terms;
  const auto add = [&](const MemberTable& members) {
    TermSpec term{members.selection, members.weight,
                  members.directions.empty() ? all : members.directions, members.axes};
    term.selection.where += ": " + what;
    const Selection selection = term.selection;
    if (!selection.surface.empty() || !selection.node_set.empty()) terms.push_back(term);
    for (const std::string& name : members.points) {
      term.selection = Selection{"", "", name, selection.where};
      terms.push_back(term);
    }
  };
  add(own);
  for (const MemberTable& members : given) add(members);
  return terms;
}

const keys::Keys<CouplingTable>& RecipeKeys::coupling_keys() {
  CouplingTable standard;
  standard.spec.kind = "node";

  const auto rows = [this](auto& key, CouplingTable& coupling) {
    CouplingSpec& spec = coupling.spec;
    key.name("name", spec.name, "name of its set; not needed on a [[point]]");
    key.choice("kind", spec.kind, {"node", "bearing", "mount"}, "kind of its set");
    key.value("point", coupling, "three coordinates or a name",
              "position of the reference node [length_unit], or the name of a [[point]] "
              "that is it; the surface's centroid without it",
              [](const Config& table, const std::string& name, CouplingTable& c) {
                if (!table.is_list(name))
                  c.spec.on_point = table.text(name);
                else
                  c.spec.at = table.metre() * Eigen::Vector3d(table.numbers(name, 3).data());
              })
        .types({Type::kText, Type::kNumbers});
    key.choice("type", spec.rigid, {{"distributing", false}, {"rigid", true}},
               "whether the reference follows a surface or nodes, or these follow it");
    member_rows(key, coupling.members);
    key.tables("term", coupling.terms, member_keys(false))
        .needs("type", "distributing", "followers have no weights");
    directions(key, spec.directions,
               "directions of the reference node, of a rigid coupling those of the followers; all "
               "without it");
    key.integer("dofs", coupling.dofs, {3, 6},
                "6 or 3: of the reference node, as directions = \"xyz\"")
        .needs("type", "distributing")
        .excludes("directions");
    key.check([this](const Config& table, CouplingTable& c) { finish_coupling(table, c); });
  };
  return keep<CouplingTable>(
      "coupling",
      "a reference node that follows a surface or nodes (distributing, RBE3), or that they "
      "follow (rigid, RBE2)",
      rows, standard);
}

void RecipeKeys::finish_coupling(const Config& table, CouplingTable& c) {
  CouplingSpec& spec = c.spec;
  if (spec.on_point.empty()) {
    if (spec.name.empty())
      table.fail("name", "is missing, a coupling without a [[point]] needs it");
    names_.add_set(table, spec.name);
  } else {
    check_known(table, "point", spec.on_point, names_.points);
    if (table.has("kind")) table.fail("kind", "is that of the [[point]]: leave it out");
    if (spec.name.empty()) spec.name = "on " + spec.on_point;
    spec.kind.clear();
  }
  if (c.dofs && *c.dofs != 3 && *c.dofs != 6)
    table.fail("dofs", fmt::format("found {}, expected 6 or 3", *c.dofs));
  if (c.dofs == 3) spec.directions = {0, 1, 2};
  std::sort(spec.directions.begin(), spec.directions.end());
  const std::string what = "coupling " + spec.name;
  spec.where = where(table, what);
  check_members(table, c.members);
  spec.terms = terms_of(what, c.members, c.terms, {0, 1, 2});
  if (spec.terms.empty()) table.fail("surface", "give surface, node_set, points or terms");
}

const keys::Keys<TermTable>& RecipeKeys::term_keys() {
  const auto rows = [this](auto& key, TermTable& table) {
    EquationSpec::Term& term = table.term;
    select_by(key, term.selection, {"node_set", "point"});
    key.choice("direction", term.direction,
               {{"x", 0}, {"y", 1}, {"z", 2}, {"rx", 3}, {"ry", 4}, {"rz", 5}},
               "direction of the displacement or rotation")
        .required();
    key.number("coefficient", table.coefficient, {},
               "coefficient in the sum; 1 of springs without it, and a lever arm [m] at a "
               "rotation beside displacements");
    key.check([this](const Config& config, TermTable& t) {
      Selection& selection = t.term.selection;
      names_.check(config, "", selection);
      t.term.coefficient = t.coefficient.value_or(1.0);
      if (!selection.point.empty()) return;
      const size_t count = names_.mesh.node_set(selection.node_set).size();
      if (count != 1) config.fail("node_set", fmt::format("found {} nodes, expected one", count));
      if (t.term.direction >= 3)
        config.fail("direction",
                    fmt::format("found \"{}\", expected x, y or z: nodes do not rotate",
                                kDofNames[t.term.direction]));
    });
  };
  return keep<TermTable>("terms", "one direction of one node or point", rows);
}

/// The terms with their position in messages.
template <class Spec>
void finish_terms(const Config& table, const std::string& what, WithTerms<Spec>& given) {
  given.spec.where = where(table, what);
  for (TermTable& one : given.terms) {
    one.term.selection.where += ": " + what;
    given.spec.terms.push_back(one.term);
  }
}

const keys::Keys<WithTerms<EquationSpec>>& RecipeKeys::equation_keys() {
  const auto rows = [this](auto& key, WithTerms<EquationSpec>& equation) {
    key.tables("terms", equation.terms, term_keys()).required();
    key.check([this](const Config& table, WithTerms<EquationSpec>& e) {
      finish_terms(table, fmt::format("equation {}", next("equation")), e);
      const std::vector<Config> parts = table.tables("terms");
      for (size_t i = 0; i < parts.size(); ++i)
        if (!e.terms[i].coefficient)
          parts[i].fail("coefficient", "found nothing, expected a number");
      if (e.terms.empty() || *e.terms[0].coefficient == 0.0)
        table.fail("terms",
                   "found none, or a first coefficient of zero, expected a dependent term "
                   "first");
    });
  };
  return keep<WithTerms<EquationSpec>>(
      "equation", "a sum of displacements that is zero; the first depends on the others", rows);
}

/// Rotations beside displacements have a lever arm.
const keys::Keys<WithTerms<SpringSpec>>& RecipeKeys::spring_keys() {
  const auto rows = [this](auto& key, WithTerms<SpringSpec>& spring) {
    key.text("name", spring.spec.name, "name for messages; spring_1, spring_2, ... without it");
    key.number("stiffness", spring.spec.stiffness, Range::positive(),
               "force over the sum; moment over it where all are rotations [N m/rad]")
        .required()
        .shown_in("N/m");
    key.tables("terms", spring.terms, term_keys()).required();
    key.check([this](const Config& table, WithTerms<SpringSpec>& s) {
      const int number = next("spring");
      if (s.spec.name.empty()) s.spec.name = fmt::format("spring_{}", number);
      finish_terms(table, "spring " + s.spec.name, s);
      const std::vector<Config> parts = table.tables("terms");
      for (size_t i = 0; i < parts.size(); ++i) {
        if (s.terms[i].coefficient == 0.0)
          parts[i].fail("coefficient", "found 0, expected a nonzero number");
        if (s.terms[i].term.direction / 3 != s.terms[0].term.direction / 3 &&
            !s.terms[i].coefficient)
          parts[i].fail("coefficient",
                        "found none at a rotation beside a displacement, expected a lever "
                        "arm [m]");
      }
      if (parts.empty()) table.fail("terms", "found none, expected one (to the ground) or more");
    });
  };
  return keep<WithTerms<SpringSpec>>(
      "spring", "a stiffness of a sum of displacements, one to the ground or several", rows);
}

const keys::Keys<WithTerms<MatrixSpec>>& RecipeKeys::matrix_keys() {
  const auto rows = [this](auto& key, WithTerms<MatrixSpec>& matrix) {
    key.text("name", matrix.spec.name, "name for messages; matrix_1, matrix_2, ... without it");
    key.tables("terms", matrix.terms, term_keys(),
               "its rows, one direction of one node or point each")
        .required();
    key.numbers("K", matrix.K, {}, "stiffness: the lower triangle, row by row [N/m, N, N m]");
    key.numbers("M", matrix.M, {}, "mass: the lower triangle, row by row [kg, kg m, kg m2]");
    key.one_of({"K", "M"});
    key.check([this](const Config& table, WithTerms<MatrixSpec>& m) {
      const int number = next("matrix");
      if (m.spec.name.empty()) m.spec.name = fmt::format("matrix_{}", number);
      finish_terms(table, "matrix " + m.spec.name, m);
      m.spec.is_mass = table.has("M");
      const std::vector<double>& lower = m.spec.is_mass ? m.M : m.K;
      const auto n = static_cast<Eigen::Index>(m.terms.size());
      if (n == 0 || static_cast<Eigen::Index>(lower.size()) != n * (n + 1) / 2)
        table.fail(m.spec.is_mass ? "M" : "K",
                   fmt::format("found {} numbers for {} terms, expected {}: the lower "
                               "triangle row by row",
                               lower.size(), n, n * (n + 1) / 2));
      Eigen::MatrixXd& values = m.spec.values;
      values.resize(n, n);
      size_t at = 0;
      for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j <= i; ++j) values(i, j) = values(j, i) = lower[at++];
    });
  };
  return keep<WithTerms<MatrixSpec>>("matrix", "stiffness or mass between DoFs, beside the cells",
                                     rows);
}

const keys::Keys<StraightEdgesSpec>& RecipeKeys::straight_edges_keys() {
  const auto rows = [this](auto& key, StraightEdgesSpec& edges) {
    key.text("node_set", edges.node_set, "a set of mid-side nodes of the mesh").required();
    key.check([this](const Config& table, StraightEdgesSpec& e) {
      names_.check_node_set(table, e.node_set);
      e.where = where(table, "straight edges " + e.node_set);
    });
  };
  return keep<StraightEdgesSpec>(
      "straight_edges", "mid-side nodes that move with the mean of the two ends of their edge",
      rows);
}

const keys::Keys<TieSpec>& RecipeKeys::tie_keys(bool bolt) {
  TieSpec standard;
  standard.bolt = bolt;
  const char* meaning = bolt ? "a cut shank: a tie with one free relative displacement, its tension"
                             : "a slave surface that follows a master surface, with other nodes";

  const auto rows = [this, bolt](auto& key, TieSpec& tie) {
    auto name = key.text("name", tie.name, bolt ? "name of its set" : "name for messages and heat");
    if (bolt) name.required();
    key.text("slave", tie.slave, "a surface of the mesh, which follows").required();
    key.text("master", tie.master, "a surface of the mesh").required();
    key.number("distance", tie.distance, Range::not_negative(),
               "largest gap; a tenth of the mean slave face's size without it")
        .in_length_unit();
    if (bolt)
      key.direction("direction", tie.direction, "direction from slave to master").required();
    key.check([this](const Config& table, TieSpec& t) {
      const int number = next("tie");
      if (t.bolt) names_.add_set(table, t.name);
      if (t.name.empty()) t.name = fmt::format("tie_{}", number);
      names_.ties.insert(t.name);
      t.where = where(table, fmt::format("{} {}", t.bolt ? "bolt" : "tie", t.name));
      names_.check_surface(table, t.slave, "slave");
      names_.check_surface(table, t.master, "master");
      if (t.slave == t.master)
        table.fail("master", "found the slave surface, expected another one");
    });
  };
  return keep<TieSpec>(bolt ? "bolt" : "tie", meaning, rows, standard);
}

}  // namespace clatter::assembly
