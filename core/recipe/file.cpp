// SPDX-License-Identifier: GPL-3.0-or-later
// The whole file, with [material], [mass], [damping].
#include <fmt/format.h>

#include <numbers>

#include "core/recipe/tables.hpp"

namespace clatter::recipe {
namespace {

const Keys<RegionMaterial>& region_material_keys() {
  static const Keys<RegionMaterial> keys(
      "material", "a material of some regions", [](auto& key, RegionMaterial& material) {
        key.source(material.source);
        key.texts("regions", material.regions, "regions of the mesh that have it");
        key.part(material.material, fe::material_keys());
      });
  return keys;
}

const Keys<Mass>& mass_keys() {
  static const Keys<Mass> keys("mass", "the mass matrix", [](auto& key, Mass& mass) {
    key.source(mass.source);
    key.choice("lumping", mass.form,
               {{"consistent", fe::MassForm::kConsistent}, {"hrz", fe::MassForm::kHrz}},
               "consistent, or lumped by Hinton, Rock and Zienkiewicz");
  });
  return keys;
}

/// zeta = alpha w / 2 + beta / (2 w): `ratio` at `at_hz` gives alpha, given beta.
const Keys<Damping>& damping_keys() {
  static const Keys<Damping> keys(
      "damping", "damping D = alpha K + beta M", [](auto& key, Damping& damping) {
        key.source(damping.source);
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
        key.check([](const Config& table, Damping& d) {
          if (!d.ratio) return;
          const double omega = 2.0 * std::numbers::pi * *d.at_hz;
          d.alpha = (2.0 * *d.ratio - d.beta / omega) / omega;
          if (d.alpha < 0.0)
            table.fail("ratio",
                       fmt::format("found {:g}, but beta alone gives more, expected at least {:g}",
                                   *d.ratio, 0.5 * d.beta / omega));
          d.ratio.reset();
          d.at_hz.reset();
        });
      });
  return keys;
}

const Keys<Prestress>& prestress_keys() {
  static const Keys<Prestress> keys(
      "prestress",
      "a case of static results whose stress makes the part stiffer where it pulls and softer "
      "where "
      "it presses, across its direction",
      [](auto& key, Prestress& prestress) {
        key.source(prestress.source);
        key.path("file", prestress.file,
                 "static results (.static.h5) of the same mesh, by clatter-modal statics")
            .required();
        key.text("case", prestress.of_case,
                 "case of these results; needed where they have several");
        key.number("factor", prestress.factor, {}, "of its stress");
      });
  return keys;
}

}  // namespace

const Keys<File>& file_keys() {
  static const Keys<File> keys(
      "fe.toml", "materials of a part, what is joined, held and loaded, and the sets that are kept",
      [](auto& key, File& file) {
        key.source(file.source);
        key.length_unit("length_unit", file.metre, {{"m", 1.0}, {"mm", 1e-3}},
                        "unit of the lengths of this file that name none")
            .always();
        key.named("system", file.systems, fe::axes_keys());
        key.named("material", file.materials, region_material_keys());
        key.tables("shell", file.shells, shell_keys());
        key.table("matrices", file.matrix_files, matrix_files_keys())
            .excludes("material", "the matrices are the part");
        key.tables("part", file.parts, part_keys());
        key.table("mass", file.mass, mass_keys());
        key.table("damping", file.damping, damping_keys());
        key.table("prestress", file.prestress, prestress_keys())
            .excludes("matrices", "they have no cells");
        key.tables("point", file.points, point_keys());
        key.tables("support", file.supports, support_keys());
        key.tables("coupling", file.couplings, coupling_keys());
        key.tables("equation", file.equations, equation_keys());
        key.tables("spring", file.springs, spring_keys());
        key.tables("beam", file.beams, beam_keys());
        key.tables("matrix", file.matrices, matrix_keys());
        key.tables("straight_edges", file.straight_edges, straight_edges_keys());
        key.tables("tie", file.ties, tie_keys());
        key.tables("bolt", file.bolts, bolt_keys());
        key.tables("gasket", file.gaskets, gasket_keys());
        key.tables("contact", file.contacts, contact_keys());
        key.tables("mean", file.means, mean_keys());
        key.tables("sensor", file.sensors, sensor_keys());
        key.tables("nodes", file.nodes, nodes_keys());
        key.tables("point_mass", file.point_masses, point_mass_keys());
        key.tables("surface_mass", file.surface_masses, surface_mass_keys());
        key.tables("heat", file.heats, heat_keys());
        key.tables("load", file.loads, load_keys());
        key.tables("case", file.cases, case_keys());
      });
  return keys;
}

}  // namespace clatter::recipe
