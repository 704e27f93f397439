// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/recipe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/recipe/recipe_keys.hpp"

namespace clatter::assembly {

RecipeKeys::RecipeKeys(const mesh::Mesh& mesh) : names_{mesh} {}

const keys::Keys<RecipeTable>& RecipeKeys::file_keys() {
  const auto rows = [this](auto& key, RecipeTable& file) {
    key.length_unit("length_unit", file.metre, {{"m", 1.0}, {"mm", 1e-3}},
                    "unit of the lengths of this file that name none");
    key.named("system", file.systems, fe::axes_keys());
    key.then([this](const Config&, RecipeTable& f) {
      for (const auto& [name, table] : f.systems) names_.systems[name] = table.axes;
    });
    key.named("material", file.materials, material_keys());
    key.then(
        [this](const Config& config, RecipeTable& f) { finish_materials(config, f.materials); });
    key.table("matrices", file.matrix_files, matrix_files_keys())
        .excludes("material", "the matrices are the part");
    key.table("mass", file.mass, mass_keys());
    key.table("damping", file.damping, damping_keys());
    key.tables("point", file.points, point_keys());
    key.tables("support", file.supports, support_keys());
    key.tables("coupling", file.couplings, coupling_keys());
    key.tables("equation", file.equations, equation_keys());
    key.tables("spring", file.springs, spring_keys());
    key.tables("matrix", file.matrices, matrix_keys());
    key.tables("straight_edges", file.straight_edges, straight_edges_keys());
    key.tables("tie", file.ties, tie_keys(false));
    key.tables("bolt", file.bolts, tie_keys(true));
    key.tables("contact", file.contacts, contact_keys());
    key.tables("mean", file.means, mean_keys());
    key.tables("sensor", file.sensors, sensor_keys());
    key.tables("nodes", file.nodes, nodes_keys());
    key.tables("point_mass", file.point_masses, point_mass_keys());
    key.tables("heat", file.heats, heat_keys());
    key.tables("load", file.loads, load_keys());
    key.tables("case", file.cases, case_keys());
    key.check([this](const Config& config, RecipeTable& f) { check_hanging(config, f); });
  };
  return keep<RecipeTable>(
      "fe.toml", "materials of a part, what is joined, held and loaded, and the sets that are kept",
      rows);
}

/// Mid-side nodes without a cell of their own need straight edges.
void RecipeKeys::check_hanging(const Config& config, const RecipeTable& file) const {
  const bool named = std::any_of(
      file.straight_edges.begin(), file.straight_edges.end(),
      [](const StraightEdgesSpec& spec) { return spec.node_set == mesh::kHangingMidSideNodes; });
  if (!named && names_.mesh.node_sets.contains(mesh::kHangingMidSideNodes))
    config.fail("straight_edges",
                fmt::format("found none, the mesh has the node set \"{0}\": expected "
                            "[[straight_edges]] with node_set = \"{0}\"",
                            mesh::kHangingMidSideNodes));
}

namespace {

/// The specs of tables that have more than them.
template <class Table>
auto specs_of(std::vector<Table>& tables) {
  std::vector<decltype(Table::spec)> specs;
  for (Table& table : tables) specs.push_back(std::move(table.spec));
  return specs;
}

template <class T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

Recipe RecipeKeys::read(const Config& config) {
  RecipeTable file = file_.read(config);
  Recipe recipe{.materials = std::move(materials_),
                .mass = file.mass,
                .damping = file.damping,
                .points = std::move(file.points),
                .supports = std::move(file.supports),
                .couplings = specs_of(file.couplings),
                .equations = specs_of(file.equations),
                .springs = specs_of(file.springs),
                .matrices = specs_of(file.matrices),
                .straight_edges = std::move(file.straight_edges),
                .ties = joined(std::move(file.ties), file.bolts),
                .contacts = specs_of(file.contacts),
                .means = std::move(file.means),
                .nodes = joined(specs_of(file.sensors), specs_of(file.nodes)),
                .point_masses = specs_of(file.point_masses),
                .heats = std::move(file.heats),
                .loads = specs_of(file.loads),
                .cases = {},
                .files = std::move(files_)};
  for (CaseTable& one : file.cases) recipe.cases[one.name] = std::move(one.factors);
  return recipe;
}

Recipe read_recipe(const Config& config, const mesh::Mesh& mesh) {
  return RecipeKeys(mesh).read(config);
}

const keys::Table& recipe_table() {
  static const mesh::Mesh none;
  static const RecipeKeys keys(none);
  return keys.table();
}

}  // namespace clatter::assembly
