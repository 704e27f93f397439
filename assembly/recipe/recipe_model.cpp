// SPDX-License-Identifier: GPL-3.0-or-later
// [material], [mass], [damping].
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

#include "assembly/recipe/recipe_keys.hpp"

namespace clatter::assembly {

const keys::Keys<RegionMaterial>& RecipeKeys::material_keys() {
  const auto rows = [](auto& key, RegionMaterial& material) {
    key.texts("regions", material.regions, "regions of the mesh that have it");
    key.part(material.material, fe::material_keys());
  };
  return keep<RegionMaterial>("material", "a material of some regions", rows);
}

void RecipeKeys::finish_materials(const Config& config,
                                  const std::map<std::string, RegionMaterial>& given) {
  const std::vector<std::string>& regions = names_.mesh.regions;
  std::vector<bool> found(regions.size(), false);
  materials_.resize(regions.size());
  for (const auto& [name, material] : given) {
    const Config table = config.table("material").table(name);
    for (const std::string& one : material.regions) {
      const auto index = static_cast<size_t>(names_.region(table, "regions", one));
      if (found[index])
        table.fail("regions", fmt::format("found \"{}\" in two materials, expected one", one));
      found[index] = true;
      materials_[index] = material.material.material;
      if (!material.material.system.empty())
        materials_[index].axes = names_.axes(table, material.material.system);
    }
  }
  for (size_t r = 0; r < found.size(); ++r)
    if (!found[r])
      config.fail("material", fmt::format("found none for region \"{}\", expected one for each "
                                          "of: {}",
                                          regions[r], fmt::join(regions, ", ")));
}

const keys::Keys<fe::MassForm>& RecipeKeys::mass_keys() {
  const auto rows = [](auto& key, fe::MassForm& form) {
    key.choice("lumping", form,
               {{"consistent", fe::MassForm::kConsistent}, {"hrz", fe::MassForm::kHrz}},
               "consistent, or lumped by Hinton, Rock and Zienkiewicz");
  };
  return keep<fe::MassForm>("mass", "the mass matrix", rows);
}

/// zeta = alpha w / 2 + beta / (2 w): `ratio` at `at_hz` gives alpha, given beta.
const keys::Keys<DampingSpec>& RecipeKeys::damping_keys() {
  const auto rows = [](auto& key, DampingSpec& damping) {
    key.number("alpha", damping.alpha, Range::not_negative(), "factor alpha of the stiffness")
        .shown_in("s")
        .excludes("ratio");
    key.number("beta", damping.beta, Range::not_negative(), "factor beta of the mass")
        .shown_in("1/s");
    key.number("ratio", damping.ratio, Range::not_negative(),
               "share of critical damping at at_hz, which gives alpha");
    key.number("at_hz", damping.at_hz, Range::positive(), "frequency of the ratio")
        .needs("ratio")
        .required_with("ratio");
    key.check([](const Config& table, DampingSpec& d) {
      if (!d.ratio) return;
      const double omega = 2.0 * std::numbers::pi * *d.at_hz;
      d.alpha = (2.0 * *d.ratio - d.beta / omega) / omega;
      if (d.alpha < 0.0)
        table.fail("ratio", fmt::format("found {:g}, but beta alone gives more, expected at least "
                                        "{:g}",
                                        *d.ratio, 0.5 * d.beta / omega));
    });
  };
  return keep<DampingSpec>("damping", "damping D = alpha K + beta M", rows);
}

}  // namespace clatter::assembly
