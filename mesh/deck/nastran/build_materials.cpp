// SPDX-License-Identifier: GPL-3.0-or-later
// MAT1, MAT2, MAT8 and MAT9.
#include <fmt/format.h>

#include <cmath>

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

/// MAT8; G1Z and G2Z that are blank are G12.
std::vector<double> orthotropic(const Model& model, int32_t id, const RawMaterial& raw) {
  std::vector<double> constants = raw.constants;
  const auto fail = [&](const std::string& message) {
    model.source.fail(raw.origin, fmt::format("MAT8 {}: {}", id, message));
  };
  for (const size_t across : {7, 8})
    if (constants[across] == 0.0) constants[across] = constants[6];
  for (const size_t modulus : {0, 1, 6, 7, 8})
    if (!(constants[modulus] > 0.0))
      fail(fmt::format("found a modulus of {}, expected E1, E2, G12, G1Z and G2Z more than 0",
                       constants[modulus]));
  const double nu = constants[3];
  if (!(nu * nu * constants[1] < constants[0]))
    fail(fmt::format("found NU12 = {}, expected NU12**2 < E1 / E2", nu));
  return constants;
}

}  // namespace

Material material_of(const Model& model, int32_t id) {
  const RawMaterial& raw = model.raw.materials.at(id);
  Material material;
  if (raw.kind == Material::Kind::kIsotropic) {
    material = isotropic(model, id, raw);
  } else {
    material.constants =
        raw.kind == Material::Kind::kOrthotropic ? orthotropic(model, id, raw) : raw.constants;
  }
  material.kind = raw.kind;
  material.name = fmt::format("mat_{}", id);
  material.where = model.source.where(raw.origin);
  material.density = raw.density * model.raw.control.mass_factor;
  material.loss_factor = raw.loss_factor;
  material.expansion = raw.expansion;
  material.reference_temperature = raw.reference_temperature;
  return material;
}

std::string_view material_card(const Model& model, int32_t id) {
  const auto other = model.raw.other_materials.find(id);
  if (other != model.raw.other_materials.end()) return other->second;
  const auto found = model.raw.materials.find(id);
  if (found == model.raw.materials.end()) return {};
  if (found->second.kind == Material::Kind::kIsotropic) return "MAT1";
  if (!found->second.of_sheets) return "MAT9";
  return found->second.kind == Material::Kind::kOrthotropic ? "MAT8" : "MAT2";
}

std::string use_material(Model& model, std::string_view property, int32_t id, Origin origin) {
  const bool is_sheet = property != "PSOLID";
  const std::string_view found = material_card(model, id);
  if (found.empty() && model.raw.materials.empty() && !is_sheet) return {};
  if (found.empty())
    model.source.fail(origin, fmt::format("{}: found no material {}", property, id));
  if (found != "MAT1" && (is_sheet ? found != "MAT2" && found != "MAT8" : found != "MAT9"))
    model.source.fail(
        origin,
        fmt::format("{}: material {} is a {}, expected a MAT1{} (linear elastic): write its "
                    "constants as one of them",
                    property, id, found, is_sheet ? ", MAT2 or MAT8" : " or MAT9"));
  const std::string name = fmt::format("mat_{}", id);
  if (!model.deck.materials.contains(name)) model.deck.materials[name] = material_of(model, id);
  return name;
}

}  // namespace clatter::mesh::deck::nastran
