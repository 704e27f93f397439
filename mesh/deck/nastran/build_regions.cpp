// SPDX-License-Identifier: GPL-3.0-or-later
// PSOLID: properties of the cells.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

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
  region.where = model.source.where(solid.origin);
  region.material = use_material(model, solid.material, solid.origin);
  const auto material = model.raw.materials.find(solid.material);
  const bool isotropic =
      material == model.raw.materials.end() || material->second.kind == Material::Kind::kIsotropic;
  if (!isotropic && solid.system < 0) {
    model.source.fail(solid.origin, "PSOLID CORDM -1: axes of the cells are not supported");
  }
  if (!isotropic) region.system = model.system_name(solid.system, solid.origin);
  for (int t = 0; t < kCellTypes; ++t) {
    const auto type = static_cast<CellType>(t);
    if (!model.raw.block_index.contains({type, property})) continue;
    const Formulation formulation = formulation_of(model, solid, type);
    if (formulation != Formulation::kDefault) region.formulation[type] = formulation;
  }
  return region;
}

// At the first cell of a property.
[[noreturn]] void refuse(const Model& model, int32_t property, const std::string& message) {
  const auto& blocks = model.raw.blocks;
  const RawBlock& block = *std::find_if(blocks.begin(), blocks.end(),
                                        [&](const RawBlock& b) { return b.property == property; });
  model.source.fail(block.origins.front(), fmt::format("cell {}: {}", block.ids.front(), message));
}

}  // namespace

void build_regions(Model& model, const std::vector<int32_t>& properties) {
  std::set<std::string> names;
  for (int32_t property : properties) {
    const auto named = model.raw.region_names.find(property);
    const std::string name =
        named == model.raw.region_names.end() ? fmt::format("pid_{}", property) : named->second;
    if (!names.insert(name).second)
      refuse(model, property, "another region is named " + shown(name));
    const auto solid = model.raw.solids.find(property);
    if (solid != model.raw.solids.end()) {
      model.deck.regions.push_back(region_of(model, property, solid->second));
    } else if (model.raw.solids.empty()) {
      model.deck.regions.emplace_back();  // a mesh without properties
    } else {
      refuse(model, property, fmt::format("found no PSOLID {}", property));
    }
    model.deck.mesh.regions.push_back(name);
  }
}

}  // namespace clatter::mesh::deck::nastran
