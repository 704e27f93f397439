// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The keys of each table of a fe.toml, and rows that several tables have. shells.cpp, joints.cpp,
// kept_sets.cpp, heat.cpp and loads.cpp each define some tables.
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "core/recipe/recipe.hpp"

namespace clatter::recipe {

using keys::Keys;
using keys::Row;

const Keys<Part>& part_keys();
const Keys<Point>& point_keys();
const Keys<Support>& support_keys();
const Keys<Coupling>& coupling_keys();
const Keys<Equation>& equation_keys();
const Keys<Spring>& spring_keys();
const Keys<Beam>& beam_keys();
const Keys<Shell>& shell_keys();
const Keys<Matrix>& matrix_keys();
const Keys<StraightEdges>& straight_edges_keys();
const Keys<Tie>& tie_keys();
const Keys<Tie>& bolt_keys();
const Keys<Gasket>& gasket_keys();
const Keys<Contact>& contact_keys();
const Keys<Mean>& mean_keys();
const Keys<Sensor>& sensor_keys();
const Keys<Nodes>& nodes_keys();
const Keys<PointMass>& point_mass_keys();
const Keys<SurfaceMass>& surface_mass_keys();
const Keys<Heat>& heat_keys();
const Keys<Load>& load_keys();
const Keys<Case>& case_keys();

/// [[.term]] of [[coupling]], or of [[nodes]], whose directions may be those of a system.
const Keys<Members>& member_keys(bool turned);

/// Rows of nodes and points.
template <class Rows>
void member_rows(Rows& key, Members& members) {
  key.text("surface", members.selection.surface, "a surface of the mesh");
  key.text("node_set", members.selection.node_set, "or a set of nodes of the mesh")
      .excludes("surface");
  key.texts("points", members.points, "names of [[point]] tables, in addition");
}

/// Its row of [[nodes]].
template <class Rows>
void system_row(Rows& key, Members& members) {
  key.text("system", members.system,
           "name of a [system] with the directions at each node; the basic frame without it");
}

/// The rows of a selection, of which one is given.
template <class Rows>
void select_by(Rows& key, Selection& selection, std::vector<std::string> names) {
  for (const std::string& name : names) {
    if (name == "surface") key.text(name, selection.surface, "a surface of the mesh");
    if (name == "node_set") key.text(name, selection.node_set, "a set of nodes of the mesh");
    if (name == "point") key.text(name, selection.point, "the name of a [[point]]");
  }
  key.one_of(std::move(names));
}

/// "xyz" or ["x", "rz"]: each of x y z rx ry rz at most once.
std::vector<int> read_directions(const Config& table, const std::string& key);
/// ["x", "rz"]; "" for none.
std::string directions_text(const std::vector<int>& directions);

/// The row `directions`, or another name.
template <class Rows>
Row directions(Rows& key, std::vector<int>& at, std::string meaning,
               std::string name = "directions") {
  return key
      .value(
          std::move(name), at, "letters as \"xyz\", or a list of x, y, z, rx, ry, rz",
          std::move(meaning),
          [](const Config& table, const std::string& name, std::vector<int>& found) {
            found = read_directions(table, name);
          },
          [](const keys::Key&, const std::vector<int>& all) { return directions_text(all); })
      .types({keys::Type::kText, keys::Type::kTexts})
      .always();
}

}  // namespace clatter::recipe
