// SPDX-License-Identifier: GPL-3.0-or-later
// Properties and materials of the cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// MAT1 gives two of E, G, NU, or all three. Solids have E and NU; a G that deviates by more than
// this is refused.
constexpr double kModulusTolerance = 0.01;

Material isotropic(const Model& model, int32_t id, const RawMaterial& raw) {
  auto [E, G, nu] = raw.moduli;
  const auto fail = [&](const std::string& message) {
    model.source.fail(raw.origin, fmt::format("MAT1 {}: {}", id, message));
  };
  if (std::isnan(E) + std::isnan(G) + std::isnan(nu) > 1) fail("expected two of E, G and NU");
  if (std::isnan(E)) E = 2.0 * G * (1.0 + nu);
  if (std::isnan(nu)) nu = E / (2.0 * G) - 1.0;
  if (!(E > 0.0) || !std::isfinite(E)) fail(fmt::format("found E = {}, expected more than 0", E));
  if (!(nu > -1.0 && nu < 0.5)) {
    fail(fmt::format("found NU = {}, expected more than -1 and less than 0.5", nu));
  }
  const double shear = E / (2.0 * (1.0 + nu));
  if (!std::isnan(G) && std::abs(G - shear) > kModulusTolerance * shear) {
    fail(fmt::format("found G = {}, expected E / (2 (1 + NU)) = {} or a blank field", G, shear));
  }
  Material out;
  out.constants = {E, nu};
  return out;
}

// Name of the material; empty when the deck has none at all.
std::string use_material(Model& model, int32_t id, const RawSolid& solid) {
  const auto at = model.bulk.materials.find(id);
  if (at == model.bulk.materials.end()) {
    if (model.bulk.materials.empty()) return {};
    model.source.fail(solid.origin, fmt::format("PSOLID: found no material {}", id));
  }
  const RawMaterial& raw = at->second;
  const std::string name = fmt::format("mat_{}", id);
  if (model.deck.materials.contains(name)) return name;
  Material material;
  if (raw.kind == Material::Kind::kIsotropic) {
    material = isotropic(model, id, raw);
  } else {
    material.constants = raw.constants;
  }
  material.kind = raw.kind;
  material.name = name;
  material.where = model.where(raw.origin);
  material.density = raw.density * model.bulk.control.mass_factor;
  material.expansion = raw.expansion;
  material.reference_temperature = raw.reference_temperature;
  model.deck.materials[name] = material;
  return name;
}

// IN and ISOP of PSOLID. Eight-node cells with bubble functions are closest to incompatible modes,
// our default; 20-node cells have 2 or 3 points along an edge.
Formulation formulation_of(const Model& model, const RawSolid& solid, CellType type) {
  const auto is = [](const std::string& text, std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), text) != names.end();
  };
  const bool two = is(solid.integration, {"TWO", "2"});
  const bool three = is(solid.integration, {"THREE", "3"});
  if (!two && !three && !is(solid.integration, {"", "0", "BUBBLE"})) {
    model.source.fail(solid.origin,
                      fmt::format("PSOLID IN: found {}, expected BUBBLE, TWO or THREE",
                                  shown(solid.integration)));
  }
  const bool full = is(solid.scheme, {"FULL", "1"});
  if (!full && !is(solid.scheme, {"", "0", "REDUCED"})) {
    model.source.fail(solid.origin, fmt::format("PSOLID ISOP: found {}, expected REDUCED or FULL",
                                                shown(solid.scheme)));
  }
  if (type == CellType::kHex8 && two && full) return Formulation::kFull;
  if (type == CellType::kHex20 && two) return Formulation::kReduced;
  if (type == CellType::kHex20 && three) return Formulation::kFull;
  return Formulation::kDefault;
}

Region region_of(Model& model, int32_t property, const RawSolid& solid) {
  Region region;
  region.where = model.where(solid.origin);
  region.material = use_material(model, solid.material, solid);
  const auto material = model.bulk.materials.find(solid.material);
  const bool isotropic =
      material == model.bulk.materials.end() || material->second.kind == Material::Kind::kIsotropic;
  if (!isotropic && solid.system < 0) {
    model.source.fail(solid.origin, "PSOLID CORDM -1: axes of the cells are not supported");
  }
  if (!isotropic) region.system = model.system_name(solid.system, solid.origin);
  for (int t = 0; t < kCellTypes; ++t) {
    const auto type = static_cast<CellType>(t);
    if (!model.bulk.block_index.contains({type, property})) continue;
    const Formulation formulation = formulation_of(model, solid, type);
    if (formulation != Formulation::kDefault) region.formulation[type] = formulation;
  }
  return region;
}

// At the first cell of a property.
[[noreturn]] void refuse(const Model& model, int32_t property, const std::string& message) {
  const auto& blocks = model.bulk.blocks;
  const RawBlock& block = *std::find_if(blocks.begin(), blocks.end(),
                                        [&](const RawBlock& b) { return b.property == property; });
  model.source.fail(block.origins.front(), fmt::format("cell {}: {}", block.ids.front(), message));
}

}  // namespace

void build_regions(Model& model, const std::vector<int32_t>& properties) {
  std::set<std::string> names;
  for (int32_t property : properties) {
    const auto named = model.bulk.region_names.find(property);
    const std::string name =
        named == model.bulk.region_names.end() ? fmt::format("pid_{}", property) : named->second;
    if (!names.insert(name).second)
      refuse(model, property, "another region is named " + shown(name));
    const auto solid = model.bulk.solids.find(property);
    if (solid != model.bulk.solids.end()) {
      model.deck.regions.push_back(region_of(model, property, solid->second));
    } else if (model.bulk.solids.empty()) {
      model.deck.regions.emplace_back();  // a mesh without properties
    } else {
      refuse(model, property, fmt::format("found no PSOLID {}", property));
    }
    model.deck.mesh.regions.push_back(name);
  }
}

}  // namespace clatter::mesh::deck::nastran
