// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/recipe/materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/keys/member.hpp"

namespace clatter::mesh::deck {
namespace {

void set_constants(const Material& material, fe::MaterialTable& out) {
  const std::vector<double>& c = material.constants;
  const auto some = [&c](size_t first, size_t count) {
    return std::vector<double>(c.begin() + static_cast<std::ptrdiff_t>(first),
                               c.begin() + static_cast<std::ptrdiff_t>(first + count));
  };
  const size_t each = material.kind == Material::Kind::kIsotropic ? 1 : 3;
  if (material.kind == Material::Kind::kAnisotropic) {
    out.C = c;
    return;
  }
  out.E = some(0, each);
  out.nu = some(each, each);
  if (each == 3) out.G = some(6, 3);
}

/// The integration of a cell type, where the assembler has a choice.
void set_integration(CellType type, Formulation formulation, recipe::RegionMaterial& out) {
  using fe::Integration;
  fe::IntegrationChoice& choice = out.material.material.integration;
  Integration* const of = type == CellType::kHex8      ? &choice.hex8
                          : type == CellType::kHex20   ? &choice.hex20
                          : type == CellType::kWedge6  ? &choice.wedge6
                          : type == CellType::kWedge15 ? &choice.wedge15
                                                       : nullptr;
  if (of == nullptr || formulation == Formulation::kDefault) return;
  const bool one_point = type == CellType::kHex8 && formulation == Formulation::kReduced;
  *of = formulation == Formulation::kFull                    ? Integration::kFull
        : formulation == Formulation::kFine                  ? Integration::kFine
        : formulation == Formulation::kReduced && !one_point ? Integration::kReduced
                                                             : Integration::kIncompatible;
  if (one_point) out.source.remark("hex8", "the deck has one point and hourglass control");
}

/// Shells may have the mass of their area alone.
bool has_area_mass(const Deck& deck, const Region& region) {
  const std::string& name = deck.mesh.regions[static_cast<size_t>(&region - deck.regions.data())];
  return std::ranges::any_of(deck.shells, [&](const recipe::Shell& shell) {
    return shell.section.area_mass > 0.0 &&
           std::ranges::find(shell.regions, name) != shell.regions.end();
  });
}

recipe::RegionMaterial material_of(const Deck& deck, const Region& region) {
  const auto found = deck.materials.find(region.material);
  if (found == deck.materials.end())
    throw InputError(
        fmt::format("{}: material {} is not in the deck", region.where, region.material));
  const Material& material = found->second;
  recipe::RegionMaterial out;
  out.source = keys::Source(material.where);
  set_constants(material, out.material);
  out.material.material.density = material.density;
  if (!(material.density > 0.0) && has_area_mass(deck, region)) {
    out.material.material.density = 1e-9;  // beside it no digit of the area's mass changes
    out.source.remark("rho", "the deck has none: its shells have the mass of their area");
  } else if (!(material.density > 0.0)) {
    out.material.material.density = 1.0;
    out.source.remark("rho",
                      "the deck has none: mass and frequencies are meaningless with this one");
  }
  out.material.expansion = material.expansion;
  out.material.system = region.system;
  for (const auto& [type, formulation] : region.formulation)
    set_integration(type, formulation, out);
  return out;
}

}  // namespace

void add_materials(const Deck& deck, Recipe& recipe) {
  std::map<std::string, std::string> names;  // of the tables, by the deck's name and their text
  for (size_t r = 0; r < deck.regions.size(); ++r) {
    const Region& region = deck.regions[r];
    const std::string& region_name = deck.mesh.regions[r];
    if (region.material.empty()) {
      recipe.remarks.push_back(
          fmt::format("region {} has no material in the deck: name it in a [material.NAME]",
                      keys::toml_text(region_name)));
      continue;
    }
    recipe::RegionMaterial material = material_of(deck, region);
    std::string& name =
        names[region.material + "\n" + fe::material_keys().text_of(material.material)];
    if (name.empty()) {
      name = region.material;
      for (int k = 2; recipe.file.materials.contains(name); ++k)
        name = fmt::format("{}_{}", region.material, k);
      recipe.file.materials[name] = std::move(material);
    }
    recipe.file.materials[name].regions.push_back(region_name);
  }
}

}  // namespace clatter::mesh::deck
