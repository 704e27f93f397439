// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/recipe_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace clatter::assembly {

void check_known(const Config& table, std::string_view key, const std::string& name,
                 const std::set<std::string>& available) {
  if (!available.contains(name))
    table.fail(key,
               fmt::format("found \"{}\", expected one of: {}", name, fmt::join(available, ", ")));
}

std::string where(const Config& table, const std::string& what) {
  return what.empty() ? table.where() : fmt::format("{}: {}", table.where(), what);
}

void RecipeNames::check_surface(const Config& table, const std::string& name,
                                std::string_view key) const {
  check_known(table, key, name, names_of(mesh.surfaces));
  if (mesh.surfaces.at(name).face_count() == 0)
    table.fail(key, fmt::format("found \"{}\" without faces, expected some", name));
}

void RecipeNames::check_node_set(const Config& table, const std::string& name) const {
  check_known(table, "node_set", name, names_of(mesh.node_sets));
  if (mesh.node_sets.at(name).empty())
    table.fail("node_set", fmt::format("found \"{}\" without nodes, expected some", name));
}

void RecipeNames::check(const Config& table, const std::string& what, Selection& selection) const {
  selection.where = where(table, what);
  if (!selection.surface.empty()) check_surface(table, selection.surface);
  if (!selection.node_set.empty()) check_node_set(table, selection.node_set);
  if (!selection.point.empty()) check_known(table, "point", selection.point, points);
}

int32_t RecipeNames::region(const Config& table, std::string_view key,
                            const std::string& name) const {
  check_known(table, key, name, {mesh.regions.begin(), mesh.regions.end()});
  const auto found = std::find(mesh.regions.begin(), mesh.regions.end(), name);
  return static_cast<int32_t>(found - mesh.regions.begin());
}

void RecipeNames::add_set(const Config& table, const std::string& name) {
  if (!sets.insert(name).second)
    table.fail("name", fmt::format("found \"{}\" twice, expected different names", name));
}

const fe::Axes& RecipeNames::axes(const Config& table, const std::string& name) const {
  static const fe::Axes global;
  if (name.empty()) return global;
  check_known(table, "system", name, names_of(systems));
  return systems.at(name);
}

std::vector<int> read_directions(const Config& table, const std::string& key) {
  std::vector<std::string> names;
  if (table.is_list(key))
    names = table.texts(key);
  else
    for (const char axis : table.text(key)) names.emplace_back(1, axis);
  std::vector<int> found;
  for (const std::string& name : names) {
    const auto* const at = std::find(kDofNames.begin(), kDofNames.end(), name);
    const auto d = static_cast<int>(at - kDofNames.begin());
    if (at == kDofNames.end() || std::find(found.begin(), found.end(), d) != found.end())
      table.fail(key, fmt::format("found \"{}\", expected each of {} at most once",
                                  fmt::join(names, " "), fmt::join(kDofNames, " ")));
    found.push_back(d);
  }
  if (found.empty()) table.fail(key, "found none, expected at least one direction");
  return found;
}

void check_directions(const Config& table, const Selection& selection,
                      const std::vector<int>& directions) {
  for (const int d : directions)
    if (d >= 3 && selection.point.empty())
      table.fail("directions", fmt::format("found \"{}\", expected x, y or z: nodes do not rotate",
                                           kDofNames[d]));
}

}  // namespace clatter::assembly
