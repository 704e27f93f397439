// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the tables of a fe.toml name: parts of the mesh, and each other.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/recipe/recipe.hpp"
#include "core/keys/keys.hpp"

namespace clatter::assembly {

/// The names in use; functions fail with "file:line: key: found ..., expected one of ...".
struct RecipeNames {
  const mesh::Mesh& mesh;
  std::set<std::string> sets{}, points{};  // sets: also of points
  std::set<std::string> ties{}, heats{}, loads{};
  std::map<std::string, fe::Axes> systems{};

  /// The surface or node set exists and is not empty.
  void check_surface(const Config& table, const std::string& name,
                     std::string_view key = "surface") const;
  void check_node_set(const Config& table, const std::string& name) const;
  /// Its surface, node set or point exists; sets `where`.
  void check(const Config& table, const std::string& what, Selection& selection) const;
  /// The number of a region.
  int32_t region(const Config& table, std::string_view key, const std::string& name) const;
  /// Adds the name of a set.
  void add_set(const Config& table, const std::string& name);
  const fe::Axes& axes(const Config& table, const std::string& name) const;
};

/// Fails unless `name` is one of `available`.
void check_known(const Config& table, std::string_view key, const std::string& name,
                 const std::set<std::string>& available);
/// "file:line: what", for messages of later steps; "file:line" for "".
std::string where(const Config& table, const std::string& what);

/// The keys of a map.
template <typename Map>
std::set<std::string> names_of(const Map& map) {
  std::set<std::string> names;
  for (const auto& entry : map) names.insert(entry.first);
  return names;
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
/// Refuses rotations of nodes, which have none.
void check_directions(const Config& table, const Selection& selection,
                      const std::vector<int>& directions);

/// The row `directions`.
template <class Rows>
keys::Row directions(Rows& key, std::vector<int>& at, std::string meaning) {
  return key
      .value("directions", at, "letters as \"xyz\", or a list of x, y, z, rx, ry, rz",
             std::move(meaning),
             [](const Config& table, const std::string& name, std::vector<int>& found) {
               found = read_directions(table, name);
             })
      .types({keys::Type::kText, keys::Type::kTexts});
}

}  // namespace clatter::assembly
