// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reads a fe.toml. All tables share the mesh, the length unit and the names in use.
// recipe_model.cpp, recipe_couplings.cpp, recipe_sets.cpp, recipe_heat.cpp and recipe_loads.cpp
// each read some tables.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/recipe/point_table.hpp"
#include "assembly/recipe/recipe.hpp"

namespace clatter::assembly {

class RecipeReader {
 public:
  RecipeReader(const Config& config, const mesh::Mesh& mesh);

  /// Reads all tables; rejects unknown keys.
  Recipe read();

 private:
  [[noreturn]] static void fail_unknown(const Config& table, std::string_view key,
                                        const std::string& found,
                                        const std::vector<std::string>& available);
  static std::string where(const Config& table, const std::string& what);
  static Eigen::Vector3d vector(const Config& table, std::string_view key);
  static Eigen::Vector3d unit_vector(const Config& table, std::string_view key);
  Eigen::Vector3d point(const Config& table, std::string_view key) const;
  std::optional<std::pair<double, double>> range(const Config& table, std::string_view key) const;
  /// "xyz" or ["x", "rz"]; the first `allowed` of x y z rx ry rz may occur, each once.
  static std::vector<int> directions(const Config& table, std::string_view key,
                                     const std::vector<int>& fallback, int allowed);
  std::string surface(const Config& table, std::string_view key = "surface") const;
  std::string node_set(const Config& table) const;
  /// A selection by `surface` or `node_set`, with `or_point` also by `point`.
  Selection selection(const Config& table, const std::string& what, bool or_point = false) const;
  std::string new_set(const Config& table);
  std::string known_set(const Config& table, std::string_view key) const;
  std::string known_point(const Config& table, std::string_view key, const std::string& name) const;
  fe::Axes axes(const Config& table) const;

  void systems();
  void materials(Recipe& recipe) const;
  void mass(Recipe& recipe) const;
  void damping(Recipe& recipe) const;
  void points(Recipe& recipe);
  void supports(Recipe& recipe) const;
  void couplings(Recipe& recipe);
  void reference(const Config& table, CouplingSpec& spec);
  /// @param turned their directions may be those of a system.
  std::vector<TermSpec> terms(const Config& table, const std::string& what,
                              const std::vector<int>& all, bool turned = false) const;
  EquationSpec::Term term(const Config& table, const std::string& what) const;
  void equations(Recipe& recipe) const;
  void springs(Recipe& recipe) const;
  void matrices(Recipe& recipe) const;
  void straight_edges(Recipe& recipe) const;
  void ties(Recipe& recipe);
  void contacts(Recipe& recipe);
  static std::vector<Sector> sectors(const Config& table);
  Eigen::VectorXd axial_edges(const Config& table) const;
  void means(Recipe& recipe);
  void nodes(Recipe& recipe);
  void point_masses(Recipe& recipe) const;
  Profile profile(const Config& table, std::string_view key, Range range, double offset) const;
  HeatSpec::Film film(const Config& table, Recipe& recipe) const;
  HeatSpec::Flux flux(const Config& table, Recipe& recipe) const;
  void heats(Recipe& recipe) const;
  HeatSpec heat(const Config& table, Recipe& recipe) const;
  HeatSpec::Source heat_source(const Config& table) const;
  int32_t region(const Config& table, std::string_view key, const std::string& name) const;
  void loads(Recipe& recipe) const;
  LoadSpec load(const Config& table, Recipe& recipe) const;
  void force_load(const Config& table, LoadSpec& spec) const;
  void temperature_load(const Config& table, LoadSpec& spec, Recipe& recipe) const;
  Eigen::VectorXd rise_of_regions(const Config& table) const;
  RowMatrix values_of_table(const Config& table, const std::vector<TableColumn>& columns,
                            const std::string& on, Recipe& recipe) const;
  void centrifugal_load(const Config& table, LoadSpec& spec) const;
  void displacement_load(const Config& table, LoadSpec& spec) const;
  std::string field(const Config& table, Eigen::Index columns) const;
  void cases(Recipe& recipe) const;

  const Config& config_;
  const mesh::Mesh& mesh_;
  double metre_ = 1.0;
  std::set<std::string> sets_;    // names of sets and points
  std::set<std::string> points_;  // names of points
  std::map<std::string, fe::Axes> systems_;
};

/// The keys of a map.
template <typename Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace clatter::assembly
