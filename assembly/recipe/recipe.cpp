// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/recipe_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace clatter::assembly {

RecipeReader::RecipeReader(const Config& config, const mesh::Mesh& mesh)
    : config_(config), mesh_(mesh) {
  metre_ = config.choice("length_unit", {"m", "mm"}) == "mm" ? 1e-3 : 1.0;
}

void RecipeReader::fail_unknown(const Config& table, std::string_view key, const std::string& found,
                                const std::vector<std::string>& available) {
  table.fail(key,
             fmt::format("found \"{}\", expected one of: {}", found, fmt::join(available, ", ")));
}

std::string RecipeReader::where(const Config& table, const std::string& what) {
  return fmt::format("{}: {}", table.where(), what);
}

Eigen::Vector3d RecipeReader::vector(const Config& table, std::string_view key) {
  return Eigen::Vector3d(table.numbers(key, 3).data());
}

Eigen::Vector3d RecipeReader::point(const Config& table, std::string_view key) const {
  return metre_ * vector(table, key);
}

Eigen::Vector3d RecipeReader::unit_vector(const Config& table, std::string_view key) {
  const Eigen::Vector3d v = vector(table, key);
  if (!(v.norm() > 0.0)) table.fail(key, "found the zero vector, expected a direction");
  return v.normalized();
}

std::optional<std::pair<double, double>> RecipeReader::range(const Config& table,
                                                             std::string_view key) const {
  if (!table.has(key)) return std::nullopt;
  const std::vector<double> ends = table.numbers(key, 2);
  if (!(ends[0] < ends[1]))
    table.fail(key, fmt::format("found [{:g}, {:g}], expected ascending", ends[0], ends[1]));
  return std::pair{metre_ * ends[0], metre_ * ends[1]};
}

std::vector<int> RecipeReader::directions(const Config& table, std::string_view key,
                                          const std::vector<int>& fallback, int allowed) {
  if (!table.has(key)) return fallback;
  std::vector<std::string> names;
  if (table.is_list(key))
    names = table.texts(key);
  else
    for (const char axis : table.text(key)) names.emplace_back(1, axis);
  const auto last = kDofNames.begin() + allowed;
  std::vector<int> found;
  for (const std::string& name : names) {
    const auto at = std::find(kDofNames.begin(), last, name);
    const auto d = static_cast<int>(at - kDofNames.begin());
    if (at == last || std::find(found.begin(), found.end(), d) != found.end())
      table.fail(key, fmt::format("found \"{}\", expected each of {} at most once",
                                  fmt::join(names, " "), fmt::join(kDofNames.begin(), last, " ")));
    found.push_back(d);
  }
  if (found.empty()) table.fail(key, "found none, expected at least one direction");
  return found;
}

std::string RecipeReader::surface(const Config& table, std::string_view key) const {
  const std::string name = table.text(key);
  if (!mesh_.surfaces.contains(name)) fail_unknown(table, key, name, names_of(mesh_.surfaces));
  if (mesh_.surfaces.at(name).face_count() == 0)
    table.fail(key, fmt::format("found \"{}\" without faces, expected some", name));
  return name;
}

int32_t RecipeReader::region(const Config& table, std::string_view key,
                             const std::string& name) const {
  const auto found = std::find(mesh_.regions.begin(), mesh_.regions.end(), name);
  if (found == mesh_.regions.end()) fail_unknown(table, key, name, mesh_.regions);
  return static_cast<int32_t>(found - mesh_.regions.begin());
}

std::string RecipeReader::node_set(const Config& table) const {
  const std::string name = table.text("node_set");
  if (!mesh_.node_sets.contains(name))
    fail_unknown(table, "node_set", name, names_of(mesh_.node_sets));
  if (mesh_.node_sets.at(name).empty())
    table.fail("node_set", fmt::format("found \"{}\" without nodes, expected some", name));
  return name;
}

Selection RecipeReader::selection(const Config& table, const std::string& what,
                                  bool or_point) const {
  Selection selection;
  selection.where = where(table, what);
  const bool by_point = or_point && table.has("point");
  if (table.has("surface")) {
    if (table.has("node_set") || by_point)
      table.fail(by_point ? "point" : "node_set", "found a surface as well, expected one");
    selection.surface = surface(table);
  } else if (by_point) {
    if (table.has("node_set")) table.fail("node_set", "found a point as well, expected one");
    selection.point = known_point(table, "point", table.text("point"));
  } else {
    selection.node_set = node_set(table);
  }
  return selection;
}

std::string RecipeReader::new_set(const Config& table) {
  const std::string name = table.text("name");
  if (name.empty() || name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without '/'", name));
  if (!sets_.insert(name).second)
    table.fail("name", fmt::format("found \"{}\" twice, expected different names", name));
  return name;
}

std::string RecipeReader::known_set(const Config& table, std::string_view key) const {
  const std::string name = table.text(key);
  if (!sets_.contains(name)) fail_unknown(table, key, name, {sets_.begin(), sets_.end()});
  return name;
}

std::string RecipeReader::known_point(const Config& table, std::string_view key,
                                      const std::string& name) const {
  if (!points_.contains(name)) fail_unknown(table, key, name, {points_.begin(), points_.end()});
  return name;
}

fe::Axes RecipeReader::axes(const Config& table) const {
  if (!table.has("system")) return {};
  const std::string name = table.text("system");
  if (!systems_.contains(name)) fail_unknown(table, "system", name, names_of(systems_));
  return systems_.at(name);
}

Recipe RecipeReader::read() {
  Recipe recipe;
  systems();
  materials(recipe);
  mass(recipe);
  damping(recipe);
  points(recipe);
  supports(recipe);
  couplings(recipe);
  equations(recipe);
  springs(recipe);
  matrices(recipe);
  straight_edges(recipe);
  ties(recipe);
  contacts(recipe);
  means(recipe);
  nodes(recipe);
  point_masses(recipe);
  heats(recipe);
  loads(recipe);
  cases(recipe);
  config_.finish();
  return recipe;
}

Recipe read_recipe(const Config& config, const mesh::Mesh& mesh) {
  return RecipeReader(config, mesh).read();
}

}  // namespace clatter::assembly
