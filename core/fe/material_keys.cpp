// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/material.hpp"

namespace clatter::fe {
namespace {

/// The row of a modulus in Pa or GPa.
template <class Rows>
void modulus(Rows& key, const std::string& name, std::vector<double>& at, bool& in_gpa, Range range,
             const std::string& meaning) {
  key.one_or_more(name, at, range, meaning).shown_in("Pa");
  key.one_or_more(name + "_gpa", at, range, meaning);
  key.in_either(name, name + "_gpa", in_gpa);
}

}  // namespace

const keys::Keys<MaterialTable>& material_keys() {
  static const keys::Keys<MaterialTable> keys(
      "material", "linear elastic, isotropic, orthotropic or anisotropic",
      [](auto& key, MaterialTable& m) {
        modulus(key, "E", m.E, m.E_in_gpa, Range::positive(),
                "Young's modulus, or E1, E2, E3 of an orthotropic material");
        key.one_or_more("nu", m.nu, {},
                        "Poisson's ratio, or nu12, nu13, nu23, where nu12/E1 = nu21/E2")
            .required_with("E")
            .required_with("E_gpa");
        modulus(key, "G", m.G, m.G_in_gpa, Range::positive(),
                "shear moduli G12, G13, G23 of an orthotropic material");
        modulus(key, "C", m.C, m.C_in_gpa, {},
                "21 constants of an anisotropic material: the upper triangle, row by row, for "
                "stresses and strains 11 22 33 12 23 31");
        key.one_of({"E", "E_gpa", "C", "C_gpa"});
        key.number("rho", m.material.density, Range::positive(), "density")
            .required()
            .shown_in("kg/m3");
        key.number("loss_factor", m.material.loss_factor, Range::between(0.0, 1.0),
                   "share of the elastic energy that a cycle loses, over 2 pi: complex moduli "
                   "(1 + i loss_factor)");
        key.one_or_more("expansion", m.expansion, {},
                        "thermal expansion, one number or three along the axes")
            .shown_in("1/K");
        key.one_or_more("conductivity", m.conductivity, Range::positive(),
                        "thermal conductivity, one number or three along the axes")
            .shown_in("W/(m K)");
        key.text("system", m.system, "name of a [system] whose axes are the material's");
        const char* meaning = "integration of the stiffness of these cells";
        const auto full = std::pair{"full", Integration::kFull};
        const auto reduced = std::pair{"reduced", Integration::kReduced};
        const auto fine = std::pair{"fine", Integration::kFine};
        IntegrationChoice& of = m.material.integration;
        key.choice("hex8", of.hex8, {{"incompatible", Integration::kIncompatible}, full, fine},
                   meaning);
        key.choice("hex20", of.hex20, {full, reduced}, meaning);
        key.choice("wedge6", of.wedge6, {full, reduced, fine}, meaning);
        key.choice("wedge15", of.wedge15, {full, reduced}, meaning);
      });
  return keys;
}

}  // namespace clatter::fe
