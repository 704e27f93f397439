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

const recipe::Shell* shell_of(const Deck& deck, const std::string& region) {
  const auto found = std::ranges::find_if(deck.shells, [&](const recipe::Shell& shell) {
    return std::ranges::find(shell.regions, region) != shell.regions.end();
  });
  return found == deck.shells.end() ? nullptr : &*found;
}

/// @param shell that has it, or null: shells may have the mass of their area alone.
recipe::RegionMaterial material_of(const Deck& deck, const std::string& name,
                                   const std::string& where, const recipe::Shell* shell) {
  const auto found = deck.materials.find(name);
  if (found == deck.materials.end())
    throw InputError(fmt::format("{}: material {} is not in the deck", where, name));
  const Material& material = found->second;
  recipe::RegionMaterial out;
  out.source = keys::Source(material.where);
  set_constants(material, out.material);
  out.material.material.density = material.density;
  out.material.material.loss_factor = material.loss_factor;
  if (!(material.density > 0.0) && shell != nullptr && shell->section.area_mass > 0.0) {
    out.material.material.density = 1e-9;  // beside it no digit of the area's mass changes
    out.source.remark("rho", "the deck has none: its shells have the mass of their area");
  } else if (!(material.density > 0.0)) {
    out.material.material.density = 1.0;
    out.source.remark("rho",
                      "the deck has none: mass and frequencies are meaningless with this one");
  }
  out.material.expansion = material.expansion;
  return out;
}

class MaterialTables {
 public:
  MaterialTables(const Deck& deck, Recipe& recipe) : deck_(deck), recipe_(recipe) {}

  void add_regions() {
    for (size_t r = 0; r < deck_.regions.size(); ++r) {
      const Region& region = deck_.regions[r];
      const std::string& name = deck_.mesh.regions[r];
      const recipe::Shell* shell = shell_of(deck_, name);
      if (shell != nullptr && !shell->layers.empty()) continue;
      if (region.material.empty()) {
        recipe_.remarks.push_back(
            fmt::format("region {} has no material in the deck: name it in a [material.NAME]",
                        keys::toml_text(name)));
        continue;
      }
      recipe::RegionMaterial material = material_of(deck_, region.material, region.where, shell);
      material.material.system = region.system;
      for (const auto& [type, formulation] : region.formulation)
        set_integration(type, formulation, material);
      table_of(region.material, std::move(material)).second.regions.push_back(name);
    }
  }

  void add_shells() {
    for (const recipe::Shell& given : deck_.shells) {
      recipe::Shell& shell = recipe_.file.shells.emplace_back(given);
      const auto use = [&](const keys::Source& source, std::string& name, bool is_heavy) {
        if (name.empty()) return;
        recipe::RegionMaterial material =
            material_of(deck_, name, source.where(), is_heavy ? &given : nullptr);
        if (!is_heavy && !(deck_.materials.at(name).density > 0.0)) {
          material.source = keys::Source(deck_.materials.at(name).where);
          material.source.remark("rho", "not used: the material has no part in the mass");
        }
        name = table_of(name, std::move(material)).first;
      };
      for (recipe::ShellLayer& layer : shell.layers) use(layer.source, layer.material, true);
      use(shell.source, shell.bending_material, false);
      use(shell.source, shell.shear_material, false);
    }
  }

 private:
  using Named = std::pair<const std::string, recipe::RegionMaterial>;

  /// The table with this content, which is added where there is none.
  Named& table_of(const std::string& wish, recipe::RegionMaterial material) {
    auto& tables = recipe_.file.materials;
    std::string& name = names_[wish + "\n" + fe::material_keys().text_of(material.material)];
    if (name.empty()) {
      name = wish;
      for (int k = 2; tables.contains(name); ++k) name = fmt::format("{}_{}", wish, k);
      tables[name] = std::move(material);
    }
    return *tables.find(name);
  }

  const Deck& deck_;
  Recipe& recipe_;
  std::map<std::string, std::string> names_;  // of the tables, by the deck's name and their text
};

}  // namespace

void add_materials(const Deck& deck, Recipe& recipe) {
  MaterialTables tables(deck, recipe);
  tables.add_regions();
  tables.add_shells();
}

}  // namespace clatter::mesh::deck
