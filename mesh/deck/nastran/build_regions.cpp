// SPDX-License-Identifier: GPL-3.0-or-later
// PSOLID: properties of the cells.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// IN of PSOLID.
enum class Points { kDefault, kBubble, kTwo, kThree };

bool is_one_of(const std::string& text, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), text) != names.end();
}

Points points_of(const Model& model, const RawSolid& solid) {
  const std::string& in = solid.integration;
  if (is_one_of(in, {"TWO", "2"})) return Points::kTwo;
  if (is_one_of(in, {"THREE", "3"})) return Points::kThree;
  if (in.empty()) return Points::kDefault;
  if (is_one_of(in, {"0", "BUBBLE"})) return Points::kBubble;
  model.source.fail(solid.origin,
                    fmt::format("PSOLID IN: found {}, expected BUBBLE, TWO or THREE", shown(in)));
}

bool is_full(const Model& model, const RawSolid& solid) {
  if (is_one_of(solid.scheme, {"FULL", "1"})) return true;
  if (is_one_of(solid.scheme, {"", "0", "REDUCED"})) return false;
  model.source.fail(solid.origin, fmt::format("PSOLID ISOP: found {}, expected REDUCED or FULL",
                                              shown(solid.scheme)));
}

struct Counterpart {
  Formulation formulation = Formulation::kDefault;
  const char* what = "";  // it replaces; empty: the same
};

constexpr const char* kShear =
    "has no counterpart for the reduced shear strains of Nastran; the nearest is";
constexpr const char* kBubble =
    "has no counterpart for the bubble functions of Nastran; the nearest is";
// What comes nearest to an IN and ISOP. Tetrahedra: their points differ, their stiffness does not.
//   IN       ISOP     cells of corners               quadratic cells
//   BUBBLE   REDUCED  2 points, reduced shear,       (IN 0: as THREE)
//                     bubble functions: the default
//   TWO      REDUCED  2 points, reduced shear        2 points, reduced shear
//   TWO      FULL     2 points                       2 points
//   THREE    REDUCED  3 points, reduced shear        3 points, reduced shear: the default
//   THREE    FULL     3 points                       3 points
Counterpart counterpart_of(CellType type, Points points, bool full) {
  const bool two = points == Points::kTwo, three = points == Points::kThree;
  const bool standard = full && (two || three);
  switch (type) {
    case CellType::kHex8:
      if (standard) return {three ? Formulation::kFine : Formulation::kFull, ""};
      return {Formulation::kDefault, two || three ? kShear : kBubble};
    case CellType::kWedge6:
      if (standard) return {three ? Formulation::kFine : Formulation::kFull, ""};
      return {Formulation::kFull, kShear};
    case CellType::kHex20:
    case CellType::kWedge15:
      return {two ? Formulation::kReduced : Formulation::kFull, full ? "" : kShear};
    case CellType::kPyramid5:
    case CellType::kPyramid13:
      return {Formulation::kDefault, full ? "" : kShear};
    default:
      return {};
  }
}

const char* name_of(CellType type, Formulation formulation) {
  if (formulation == Formulation::kReduced) return "reduced integration";
  return formulation == Formulation::kDefault && type == CellType::kHex8 ? "incompatible modes"
                                                                         : "full integration";
}

std::string text_or(const std::string& text, const char* otherwise) {
  return text.empty() ? otherwise : text;
}

// One remark for all properties with the same choice.
class FormulationNotes {
 public:
  void add(const Model& model, int32_t property, const RawSolid& solid, CellType type,
           const Counterpart& found) {
    if (*found.what == 0) return;
    const CellTraits& cell = traits(type);
    Entry& entry = entries_[fmt::format("IN {}, ISOP {}: {} of {} grids {} {}",
                                        text_or(solid.integration, "blank"),
                                        text_or(solid.scheme, "blank"), cell.nastran_name,
                                        cell.nodes, found.what, name_of(type, found.formulation))];
    if (entry.count++ == 0) entry = {model.source.where(solid.origin), property, 1};
  }
  void list(Model& model) const {
    for (const auto& [text, entry] : entries_)
      model.deck.notes.push_back(
          fmt::format("{}: PSOLID {}{}, {}", entry.where, entry.property,
                      entry.count == 1 ? "" : fmt::format(" and {} more", entry.count - 1), text));
  }

 private:
  struct Entry {
    std::string where;
    int32_t property = 0;
    int count = 0;
  };
  std::map<std::string, Entry> entries_;
};

Region region_of(Model& model, int32_t property, const RawSolid& solid, FormulationNotes& notes) {
  Region region;
  region.where = model.source.where(solid.origin);
  region.material = use_material(model, "PSOLID", solid.material, solid.origin);
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
    const Counterpart found = counterpart_of(type, points_of(model, solid), is_full(model, solid));
    if (found.formulation != Formulation::kDefault) region.formulation[type] = found.formulation;
    notes.add(model, property, solid, type, found);
  }
  return region;
}

// The card of a property that is no PSOLID; empty: there is none.
std::string other_card(const Model& model, int32_t property) {
  const auto shell = model.raw.shells.find(property);
  if (shell != model.raw.shells.end()) return shell->second.card;
  const auto other = model.raw.other_properties.find(property);
  return other == model.raw.other_properties.end() ? "" : other->second;
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
  FormulationNotes notes;
  for (int32_t property : properties) {
    const auto named = model.raw.region_names.find(property);
    const std::string name =
        named == model.raw.region_names.end() ? fmt::format("pid_{}", property) : named->second;
    if (!names.insert(name).second)
      refuse(model, property, "another region is named " + shown(name));
    const auto solid = model.raw.solids.find(property);
    if (solid != model.raw.solids.end()) {
      model.deck.regions.push_back(region_of(model, property, solid->second, notes));
    } else if (model.raw.solids.empty()) {
      model.deck.regions.emplace_back();  // a mesh without properties
    } else {
      const std::string card = other_card(model, property);
      refuse(model, property,
             card.empty()
                 ? fmt::format("found no PSOLID {}", property)
                 : fmt::format("property {} is a {}, expected a PSOLID: linear elastic solids",
                               property, card));
    }
    model.deck.mesh.regions.push_back(name);
  }
  if (!model.raw.materials.empty()) notes.list(model);
}

}  // namespace clatter::mesh::deck::nastran
