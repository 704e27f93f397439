// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the tables of a fe.toml name: parts of the mesh, and each other.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/recipe/recipe.hpp"
#include "core/keys/source.hpp"

namespace clatter::assembly {

/// The names in use; functions fail with "file:line: key: found ..., expected one of ...".
struct RecipeNames {
  const mesh::Mesh& mesh;
  std::set<std::string> sets{}, points{};  // sets: also of points
  std::set<std::string> ties{}, gaskets{}, heats{}, loads{};
  std::map<std::string, fe::Axes> systems{};
  std::vector<int32_t> turning = mesh::turning_nodes(mesh);  // nodes with rotations

  /// The surface or node set exists and is not empty.
  void check_surface(const keys::Source& table, const std::string& name,
                     std::string_view key = "surface") const;
  void check_node_set(const keys::Source& table, const std::string& name,
                      const char* key = "node_set") const;
  /// The selection with its position for messages; its surface, node set or point exists.
  Selection selection(const keys::Source& table, const std::string& what,
                      const recipe::Selection& given) const;
  void check(const keys::Source& table, const recipe::Selection& selection) const;
  /// Refuses rotations where no node has any.
  void check_directions(const keys::Source& table, std::string_view key,
                        const recipe::Selection& selection,
                        const std::vector<int>& directions) const;
  /// The only node of a set.
  int32_t only_node(const keys::Source& table, const std::string& node_set) const;
  /// The number of a region.
  int32_t region(const keys::Source& table, std::string_view key, const std::string& name) const;
  /// Adds the name of a set.
  void add_set(const keys::Source& table, const std::string& name);
  const fe::Axes& axes(const keys::Source& table, const std::string& name) const;
};

/// Fails unless `name` is one of `available`.
void check_known(const keys::Source& table, std::string_view key, const std::string& name,
                 const std::set<std::string>& available);
/// "file:line: what", for messages of later steps; "file:line" for "".
std::string where(const keys::Source& table, const std::string& what);

/// The keys of a map.
template <typename Map>
std::set<std::string> names_of(const Map& map) {
  std::set<std::string> names;
  for (const auto& entry : map) names.insert(entry.first);
  return names;
}

}  // namespace clatter::assembly
