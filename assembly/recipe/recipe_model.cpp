// SPDX-License-Identifier: GPL-3.0-or-later
// [system], [material], [mass], [damping].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "assembly/recipe/recipe_reader.hpp"

namespace clatter::assembly {

void RecipeReader::systems() {
  const auto all = config_.find_table("system");
  if (!all) return;
  for (const std::string& name : all->keys())
    systems_[name] = fe::read_axes(all->table(name), metre_);
}

void RecipeReader::materials(Recipe& recipe) const {
  const auto all = config_.find_table("material");
  std::vector<bool> given(mesh_.regions.size(), false);
  recipe.materials.resize(mesh_.regions.size());
  for (const std::string& name : all ? all->keys() : std::vector<std::string>()) {
    const Config table = all->table(name);
    const fe::Material material = fe::read_material(table, systems_);
    for (const std::string& one : table.texts("regions")) {
      const auto index = static_cast<size_t>(region(table, "regions", one));
      if (given[index])
        table.fail("regions", fmt::format("found \"{}\" in two materials, expected one", one));
      given[index] = true;
      recipe.materials[index] = material;
    }
  }
  for (size_t r = 0; r < given.size(); ++r)
    if (!given[r])
      config_.fail("material",
                   fmt::format("found none for region \"{}\", expected one for each of: {}",
                               mesh_.regions[r], fmt::join(mesh_.regions, ", ")));
}

void RecipeReader::mass(Recipe& recipe) const {
  const auto table = config_.find_table("mass");
  if (table && table->choice("lumping", {"consistent", "hrz"}) == "hrz")
    recipe.mass = fe::MassForm::kHrz;
}

/// zeta = alpha w / 2 + beta / (2 w): `ratio` at `at_hz` gives alpha, given beta.
void RecipeReader::damping(Recipe& recipe) const {
  const auto table = config_.find_table("damping");
  if (!table) return;
  recipe.damping.beta = table->number_or("beta", 0.0, Range::not_negative());
  if (!table->has("ratio")) {
    recipe.damping.alpha = table->number_or("alpha", 0.0, Range::not_negative());
    return;
  }
  if (table->has("alpha")) table->fail("alpha", "found ratio as well, expected one of them");
  const double ratio = table->number("ratio", Range::not_negative());
  const double omega = 2.0 * std::numbers::pi * table->number("at_hz", Range::positive());
  recipe.damping.alpha = (2.0 * ratio - recipe.damping.beta / omega) / omega;
  if (recipe.damping.alpha < 0.0)
    table->fail("ratio",
                fmt::format("found {:g}, but beta alone gives more, expected at least {:g}", ratio,
                            0.5 * recipe.damping.beta / omega));
}

}  // namespace clatter::assembly
