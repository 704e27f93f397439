// SPDX-License-Identifier: GPL-3.0-or-later
// [[point]], [[support]], [[coupling]], [[equation]], [[spring]], [[matrix]], [[straight_edges]],
// [[tie]], [[bolt]].
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "assembly/recipe/recipe_reader.hpp"

namespace clatter::assembly {

void RecipeReader::points(Recipe& recipe) {
  for (const Config& table : config_.tables("point")) {
    PointSpec spec;
    spec.point.name = new_set(table);
    points_.insert(spec.point.name);
    spec.where = where(table, "point " + spec.point.name);
    if (table.has("node_set")) {
      if (table.has("at")) table.fail("at", "found a node_set as well, expected one");
      const std::vector<int32_t>& nodes = mesh_.node_set(node_set(table));
      if (nodes.size() != 1)
        table.fail("node_set", fmt::format("found {} nodes, expected one", nodes.size()));
      spec.point.node = nodes[0];
      spec.point.position = mesh_.nodes.row(nodes[0]).transpose();
      if (!mesh_.node_ids.empty()) spec.number = mesh_.node_ids[static_cast<size_t>(nodes[0])];
    } else {
      spec.point.position = point(table, "at");
      if (table.has("number"))
        spec.number = static_cast<int32_t>(
            table.integer("number", {1.0, std::numeric_limits<int32_t>::max()}));
    }
    recipe.points.push_back(spec);
  }
}

void RecipeReader::supports(Recipe& recipe) const {
  for (const Config& table : config_.tables("support")) {
    SupportSpec spec;
    spec.name = table.text_or("name", fmt::format("support_{}", recipe.supports.size() + 1));
    for (const SupportSpec& other : recipe.supports)
      if (other.name == spec.name)
        table.fail("name", fmt::format("found \"{}\" twice, expected different names", spec.name));
    spec.selection = selection(table, "support " + spec.name, true);
    spec.directions =
        directions(table, "directions", {0, 1, 2}, spec.selection.point.empty() ? 3 : 6);
    spec.axes = axes(table);
    recipe.supports.push_back(spec);
  }
}

/// `point`: coordinates of its own reference node, or the name of a [[point]].
void RecipeReader::reference(const Config& table, CouplingSpec& spec) {
  if (table.has("point") && !table.is_list("point")) {
    spec.on_point = known_point(table, "point", table.text("point"));
    spec.name = table.text_or("name", "on " + spec.on_point);
  } else {
    spec.name = new_set(table);
    spec.kind = table.choice("kind", {"node", "bearing", "mount"});
    if (table.has("point")) spec.at = point(table, "point");
  }
  spec.where = where(table, "coupling " + spec.name);
}

/// Selections of the table itself, then of its `term` tables; `all`: directions of those that have
/// none.
std::vector<TermSpec> RecipeReader::terms(const Config& table, const std::string& what,
                                          const std::vector<int>& all, bool turned) const {
  std::vector<TermSpec> terms;
  const auto read_selections = [&](const Config& from, const TermSpec& like) {
    TermSpec term = like;
    if (from.has("surface") || from.has("node_set")) {
      term.selection = selection(from, what);
      terms.push_back(term);
    }
    for (const std::string& name : from.texts_or("points", {})) {
      term.selection = Selection{"", "", known_point(from, "points", name), where(table, what)};
      terms.push_back(term);
    }
  };
  read_selections(table, {{}, 1.0, all, turned ? axes(table) : fe::Axes{}});
  for (const Config& part : table.tables("term")) {
    TermSpec like;
    like.weight = part.number_or("weight", 1.0, Range::positive());
    like.directions = directions(part, "directions", all, 6);
    if (turned) like.axes = axes(part);
    const size_t before = terms.size();
    read_selections(part, like);
    if (terms.size() == before)
      part.fail("term", "found no nodes, expected a surface, node_set or points");
  }
  if (terms.empty())
    table.fail("surface", "found nothing to couple, expected a surface, node_set, points or terms");
  return terms;
}

void RecipeReader::couplings(Recipe& recipe) {
  for (const Config& table : config_.tables("coupling")) {
    CouplingSpec spec;
    reference(table, spec);
    spec.rigid = table.choice("type", {"distributing", "rigid"}) == "rigid";
    if (spec.rigid && !table.tables("term").empty())
      table.fail("term", "found terms in a rigid coupling, expected none");
    spec.terms = terms(table, "coupling " + spec.name, {0, 1, 2});
    if (table.has("dofs")) {
      if (spec.rigid || table.has("directions"))
        table.fail("dofs", "found a rigid coupling or directions as well, expected directions");
      const int64_t dofs = table.integer("dofs");
      if (dofs != 6 && dofs != 3)
        table.fail("dofs", fmt::format("found {}, expected 6 or 3", dofs));
      if (dofs == 3) spec.directions = {0, 1, 2};
    }
    spec.directions = directions(table, "directions", spec.directions, 6);
    std::sort(spec.directions.begin(), spec.directions.end());
    recipe.couplings.push_back(spec);
  }
}

/// One direction of one node or point.
EquationSpec::Term RecipeReader::term(const Config& table, const std::string& what) const {
  EquationSpec::Term term;
  term.selection = selection(table, what, true);
  if (!term.selection.surface.empty())
    table.fail("surface", "found a surface, expected a node_set of one node or a point");
  const bool node = term.selection.point.empty();
  if (node && mesh_.node_set(term.selection.node_set).size() != 1)
    table.fail("node_set", fmt::format("found {} nodes, expected one",
                                       mesh_.node_set(term.selection.node_set).size()));
  const std::string name = table.text("direction");
  const auto last = kDofNames.begin() + (node ? 3 : 6);
  const auto at = std::find(kDofNames.begin(), last, name);
  if (at == last) fail_unknown(table, "direction", name, {kDofNames.begin(), last});
  term.direction = static_cast<int>(at - kDofNames.begin());
  return term;
}

void RecipeReader::equations(Recipe& recipe) const {
  for (const Config& table : config_.tables("equation")) {
    EquationSpec spec;
    spec.where = where(table, fmt::format("equation {}", recipe.equations.size() + 1));
    for (const Config& part : table.tables("terms")) {
      spec.terms.push_back(term(part, "equation"));
      spec.terms.back().coefficient = part.number("coefficient");
    }
    if (spec.terms.empty() || spec.terms[0].coefficient == 0.0)
      table.fail("terms",
                 "found none, or a first coefficient of zero, expected a dependent term first");
    recipe.equations.push_back(spec);
  }
}

/// Rotations beside displacements have a lever arm.
void RecipeReader::springs(Recipe& recipe) const {
  for (const Config& table : config_.tables("spring")) {
    SpringSpec spec;
    spec.name = table.text_or("name", fmt::format("spring_{}", recipe.springs.size() + 1));
    spec.where = where(table, "spring " + spec.name);
    spec.stiffness = table.number("stiffness", Range::positive());
    for (const Config& part : table.tables("terms")) {
      spec.terms.push_back(term(part, "spring " + spec.name));
      spec.terms.back().coefficient = part.number_or("coefficient", 1.0);
      if (spec.terms.back().coefficient == 0.0)
        part.fail("coefficient", "found 0, expected a nonzero number");
      if (spec.terms.back().direction / 3 != spec.terms.front().direction / 3 &&
          !part.has("coefficient"))
        part.fail("coefficient",
                  "found none at a rotation beside a displacement, expected a lever arm [m]");
    }
    if (spec.terms.empty()) table.fail("terms", "found none, expected one (to the ground) or more");
    recipe.springs.push_back(std::move(spec));
  }
}

/// K or M as rows, each up to the diagonal.
void RecipeReader::matrices(Recipe& recipe) const {
  for (const Config& table : config_.tables("matrix")) {
    MatrixSpec spec;
    spec.name = table.text_or("name", fmt::format("matrix_{}", recipe.matrices.size() + 1));
    spec.where = where(table, "matrix " + spec.name);
    spec.is_mass = table.has("M");
    if (spec.is_mass == table.has("K"))
      table.fail("K", fmt::format("found {}, expected one of K and M",
                                  spec.is_mass ? "M as well" : "neither K nor M"));
    for (const Config& part : table.tables("terms"))
      spec.terms.push_back(term(part, "matrix " + spec.name));
    const auto n = static_cast<Eigen::Index>(spec.terms.size());
    const char* key = spec.is_mass ? "M" : "K";
    const std::vector<double> lower = table.numbers_or(key, {});
    if (n == 0 || static_cast<Eigen::Index>(lower.size()) != n * (n + 1) / 2)
      table.fail(key, fmt::format("found {} numbers for {} terms, expected {}: the lower triangle "
                                  "row by row",
                                  lower.size(), n, n * (n + 1) / 2));
    spec.values.resize(n, n);
    size_t next = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) spec.values(i, j) = spec.values(j, i) = lower[next++];
    recipe.matrices.push_back(std::move(spec));
  }
}

void RecipeReader::straight_edges(Recipe& recipe) const {
  bool hanging = mesh_.node_sets.contains(mesh::kHangingMidSideNodes);
  for (const Config& table : config_.tables("straight_edges")) {
    const std::string set = node_set(table);
    recipe.straight_edges.push_back({set, where(table, "straight edges " + set)});
    if (set == mesh::kHangingMidSideNodes) hanging = false;
  }
  if (hanging)
    config_.fail("straight_edges",
                 fmt::format("found none, the mesh has the node set \"{0}\": expected "
                             "[[straight_edges]] with node_set = \"{0}\"",
                             mesh::kHangingMidSideNodes));
}

void RecipeReader::ties(Recipe& recipe) {
  for (const char* kind : {"tie", "bolt"})
    for (const Config& table : config_.tables(kind)) {
      TieSpec spec;
      spec.bolt = std::string_view(kind) == "bolt";
      // A tie has no set, but a name for messages.
      spec.name = spec.bolt ? new_set(table)
                            : table.text_or("name", fmt::format("tie_{}", recipe.ties.size() + 1));
      spec.where = where(table, fmt::format("{} {}", kind, spec.name));
      spec.slave = surface(table, "slave");
      spec.master = surface(table, "master");
      if (spec.slave == spec.master)
        table.fail("master", "found the slave surface, expected another one");
      if (table.has("distance"))
        spec.distance = metre_ * table.number("distance", Range::not_negative());
      if (spec.bolt) spec.direction = unit_vector(table, "direction");
      recipe.ties.push_back(spec);
    }
}

}  // namespace clatter::assembly
