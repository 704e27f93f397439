// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of properties and materials.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void add_material(const Card& card, RawDeck& raw, const RawMaterial& material) {
  const int32_t id = card.id(0, "MID");
  if (material.density < 0.0) card.fail(0, fmt::format("material {}: RHO is negative", id));
  if (!raw.materials.emplace(id, material).second) {
    card.fail(0, fmt::format("found a second material {}", id));
  }
}

/// RHO, A1 and A2 are fields 7 to 9 of both cards.
/// @param reference, loss_factor fields of TREF and GE.
void add_sheet_material(const Card& card, size_t reference, size_t loss_factor,
                        RawMaterial material, RawDeck& raw) {
  material.origin = card.origin();
  material.of_sheets = true;
  material.density = card.number_or(7, "RHO", 0.0);
  material.expansion = {card.number_or(8, "A1", 0.0), card.number_or(9, "A2", 0.0), 0.0};
  if (material.expansion == std::vector<double>(3, 0.0)) material.expansion.clear();
  material.reference_temperature = card.number_or(reference, "TREF", 0.0);
  material.loss_factor = card.number_or(loss_factor, "GE", 0.0);
  add_material(card, raw, material);
}

}  // namespace

void read_psolid(const Card& card, RawDeck& raw) {
  RawSolid solid;
  const int32_t id = card.id(0, "PID");
  solid.origin = card.origin();
  solid.material = card.id(1, "MID");
  solid.system = card.integer_or(2, "CORDM", 0);
  if (solid.system < -1) card.fail_expected(2, "CORDM", "a coordinate system, 0 or -1");
  solid.integration = card.word(3, "IN");
  card.word(4, "STRESS");
  solid.scheme = card.word(5, "ISOP");
  solid.fluid = card.text(6) == "PFLUID" || card.text(6) == "FFLUID";
  if (!solid.fluid && !card.blank(6) && card.text(6) != "SMECH")
    card.fail_expected(6, "FCTN", "SMECH, PFLUID or FFLUID");
  if (!raw.solids.emplace(id, solid).second) {
    card.fail(0, fmt::format("found a second property {}", id));
  }
}

void read_mat1(const Card& card, RawDeck& raw) {
  RawMaterial material;
  material.origin = card.origin();
  for (size_t k = 0; k < 3; ++k) material.moduli[k] = card.number_or(1 + k, "E, G or NU", kNone);
  material.density = card.number_or(4, "RHO", 0.0);
  if (!card.blank(5)) material.expansion = {card.number(5, "A")};
  material.reference_temperature = card.number_or(6, "TREF", 0.0);
  material.loss_factor = card.number_or(7, "GE", 0.0);
  add_material(card, raw, material);
}

void read_mat9(const Card& card, RawDeck& raw) {
  RawMaterial material;
  material.origin = card.origin();
  material.kind = Material::Kind::kAnisotropic;
  for (size_t k = 0; k < 21; ++k) material.constants.push_back(card.number_or(1 + k, "G", 0.0));
  material.density = card.number_or(22, "RHO", 0.0);
  for (size_t k = 0; k < 3; ++k) material.expansion.push_back(card.number_or(23 + k, "A", 0.0));
  if (material.expansion == std::vector<double>(3, 0.0)) material.expansion.clear();
  for (size_t i = 26; i < 29; ++i) {
    if (card.number_or(i, "A", 0.0) != 0.0) card.fail(i, "thermal shear strains are not supported");
  }
  material.reference_temperature = card.number_or(29, "TREF", 0.0);
  material.loss_factor = card.number_or(30, "GE", 0.0);
  add_material(card, raw, material);
}

// In the plane G11 G12 G13 G22 G23 G33; across the sheet G33.
void read_mat2(const Card& card, RawDeck& raw) {
  RawMaterial material;
  material.kind = Material::Kind::kAnisotropic;
  std::array<double, 6> g{};
  for (size_t k = 0; k < 6; ++k) g[k] = card.number_or(1 + k, "G", 0.0);
  const double across = std::max(g[0], g[3]);
  material.constants = {g[0],   g[1], 0.0, g[2], 0.0,  0.0, g[3], 0.0,  g[4], 0.0, 0.0,
                        across, 0.0,  0.0, 0.0,  g[5], 0.0, 0.0,  g[5], 0.0,  g[5]};
  if (card.number_or(10, "A3", 0.0) != 0.0)
    card.fail(10, "thermal shear strains are not supported");
  add_sheet_material(card, 11, 12, std::move(material), raw);
}

// E3, NU13 and NU23 have no part in a sheet.
void read_mat8(const Card& card, RawDeck& raw) {
  RawMaterial material;
  material.kind = Material::Kind::kOrthotropic;
  const auto modulus = [&](size_t field, const char* what) {
    return card.number_or(field, what, 0.0);
  };
  const double E2 = modulus(2, "E2");
  material.constants = {
      modulus(1, "E1"), E2, E2, modulus(3, "NU12"), 0.0, 0.0, modulus(4, "G12"), modulus(5, "G1Z"),
      modulus(6, "G2Z")};
  add_sheet_material(card, 10, 16, std::move(material), raw);
}

void read_other_property(const Card& card, RawDeck& raw) {
  raw.other_properties[card.id(0, "PID")] = card.name();
}

void read_other_material(const Card& card, RawDeck& raw) {
  raw.other_materials[card.id(0, "MID")] = card.name();
}

}  // namespace clatter::mesh::deck::nastran
