// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/recipe_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace clatter::assembly {

void check_known(const keys::Source& table, std::string_view key, const std::string& name,
                 const std::set<std::string>& available) {
  if (available.contains(name)) return;
  const std::string names =
      available.empty() ? "none" : fmt::format("{}", fmt::join(available, ", "));
  table.fail(key, fmt::format("found \"{}\", expected one of: {}", name, names));
}

std::string where(const keys::Source& table, const std::string& what) {
  const std::string at = table.where();
  return at.empty() || what.empty() ? at + what : fmt::format("{}: {}", at, what);
}

void RecipeNames::check_surface(const keys::Source& table, const std::string& name,
                                std::string_view key) const {
  check_known(table, key, name, names_of(mesh.surfaces));
  if (mesh.surfaces.at(name).face_count() == 0)
    table.fail(key, fmt::format("found \"{}\" without faces, expected some", name));
}

void RecipeNames::check_node_set(const keys::Source& table, const std::string& name,
                                 const char* key) const {
  check_known(table, key, name, names_of(mesh.node_sets));
  if (mesh.node_sets.at(name).empty())
    table.fail(key, fmt::format("found \"{}\" without nodes, expected some", name));
}

void RecipeNames::check(const keys::Source& table, const recipe::Selection& selection) const {
  if (!selection.surface.empty()) check_surface(table, selection.surface);
  if (!selection.node_set.empty()) check_node_set(table, selection.node_set);
  if (!selection.point.empty()) check_known(table, "point", selection.point, points);
}

Selection RecipeNames::selection(const keys::Source& table, const std::string& what,
                                 const recipe::Selection& given) const {
  check(table, given);
  return {given, where(table, what)};
}

int32_t RecipeNames::only_node(const keys::Source& table, const std::string& node_set) const {
  check_node_set(table, node_set);
  const std::vector<int32_t>& nodes = mesh.node_set(node_set);
  if (nodes.size() != 1)
    table.fail("node_set", fmt::format("found {} nodes, expected one", nodes.size()));
  return nodes[0];
}

int32_t RecipeNames::region(const keys::Source& table, std::string_view key,
                            const std::string& name) const {
  check_known(table, key, name, {mesh.regions.begin(), mesh.regions.end()});
  const auto found = std::find(mesh.regions.begin(), mesh.regions.end(), name);
  return static_cast<int32_t>(found - mesh.regions.begin());
}

void RecipeNames::add_set(const keys::Source& table, const std::string& name) {
  if (!sets.insert(name).second)
    table.fail("name", fmt::format("found \"{}\" twice, expected different names", name));
}

const fe::Axes& RecipeNames::axes(const keys::Source& table, const std::string& name) const {
  static const fe::Axes global;
  if (name.empty()) return global;
  check_known(table, "system", name, names_of(systems));
  return systems.at(name);
}

void RecipeNames::check_directions(const keys::Source& table, std::string_view key,
                                   const recipe::Selection& selection,
                                   const std::vector<int>& directions) const {
  const auto rotation = std::ranges::find_if(directions, [](int d) { return d >= 3; });
  if (rotation == directions.end() || !selection.point.empty()) return;
  const std::vector<int32_t> nodes = selection.surface.empty()
                                         ? mesh.node_set(selection.node_set)
                                         : mesh::nodes_of(mesh.surface(selection.surface));
  if (std::ranges::none_of(nodes,
                           [&](int32_t node) { return std::ranges::binary_search(turning, node); }))
    table.fail(key, fmt::format("found \"{}\", expected x, y or z: nodes of solids do not rotate",
                                kDofNames[*rotation]));
}

}  // namespace clatter::assembly
