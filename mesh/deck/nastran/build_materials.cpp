// SPDX-License-Identifier: GPL-3.0-or-later
// MAT1 and MAT9.
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

}  // namespace

Material material_of(const Model& model, int32_t id) {
  const RawMaterial& raw = model.raw.materials.at(id);
  Material material;
  if (raw.kind == Material::Kind::kIsotropic) {
    material = isotropic(model, id, raw);
  } else {
    material.constants = raw.constants;
  }
  material.kind = raw.kind;
  material.name = fmt::format("mat_{}", id);
  material.where = model.source.where(raw.origin);
  material.density = raw.density * model.raw.control.mass_factor;
  material.expansion = raw.expansion;
  material.reference_temperature = raw.reference_temperature;
  return material;
}

std::string use_material(Model& model, int32_t id, Origin origin) {
  const auto at = model.raw.materials.find(id);
  if (at == model.raw.materials.end()) {
    const auto other = model.raw.other_materials.find(id);
    if (other != model.raw.other_materials.end())
      model.source.fail(
          origin, fmt::format("PSOLID: material {} is a {}, expected a MAT1 or MAT9 (a solid, "
                              "linear elastic): write its constants as one of them",
                              id, other->second));
    if (model.raw.materials.empty()) return {};
    model.source.fail(origin, fmt::format("PSOLID: found no material {}", id));
  }
  const std::string name = fmt::format("mat_{}", id);
  if (!model.deck.materials.contains(name)) model.deck.materials[name] = material_of(model, id);
  return name;
}

}  // namespace clatter::mesh::deck::nastran
