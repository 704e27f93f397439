// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/oil_table.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace clatter::dynamics {
namespace {

using Law = OilTable::Law;

const Range kCelsius = Range::between(-60.0, 400.0);
const Range kThicknessUm = Range::between(1e-3, 1e5);

void check_oil(const Config& table, OilTable& oil) {
  film::ViscosityOptions& laws = oil.laws;
  if (oil.law == Law::kVogel) laws.vogel = oil.vogel;
  if (oil.law == Law::kWalther) laws.walther = oil.walther;
  if (table.has("shear_rate_1_s")) laws.cross = oil.cross;
  const auto& kinematic = oil.walther.kinematic;
  if (laws.walther && !(kinematic[0] > kinematic[1]))
    table.fail("walther_mm2_s", fmt::format("found {:g} and {:g}, expected two descending "
                                            "viscosities",
                                            1e6 * kinematic[0], 1e6 * kinematic[1]));
  const size_t values = laws.temperature.size(), heights = laws.height.size();
  if (heights != (values > 1 ? values : 0))
    table.fail("height_mm",
               fmt::format("found {} heights for {} temperatures, expected as many, none "
                           "for one temperature",
                           heights, values));
}

}  // namespace

const keys::Keys<OilTable>& oil_keys() {
  static const keys::Keys<OilTable> keys(
      "oil", "viscosity of the oil over temperature, pressure and shear rate",
      [](auto& key, OilTable& oil) {
        const keys::Values by_temperature{"vogel", "walther"};
        key.where(oil.where);
        key.choice(
            "law", oil.law,
            {{"constant", Law::kConstant}, {"vogel", Law::kVogel}, {"walther", Law::kWalther}},
            "viscosity over temperature; constant is viscosity_pa_s");
        key.number("vogel_a_pa_s", oil.vogel.a, Range::between(1e-9, 1.0),
                   "a of a exp(b / (T - c))")
            .of("law", "vogel");
        key.number("vogel_b_k", oil.vogel.b, Range::between(0.0, 1e4), "b of a exp(b / (T - c))")
            .of("law", "vogel");
        key.number("vogel_c_c", oil.vogel.c, Range::between(-270.0, 50.0),
                   "c of a exp(b / (T - c))")
            .of("law", "vogel");
        key.vector("walther_temperature_c", oil.walther.temperature, kCelsius,
                   "two temperatures at which the viscosity is known")
            .ascending()
            .of("law", "walther");
        key.vector("walther_mm2_s", oil.walther.kinematic, Range::between(0.5, 1e6),
                   "kinematic viscosity there")
            .of("law", "walther");
        key.number("density_kg_m3", oil.walther.density, Range::between(100.0, 5000.0),
                   "density of the oil")
            .of("law", "walther");
        key.one_or_more("temperature_c", oil.laws.temperature, kCelsius,
                        "of the oil film, one or at each of height_mm")
            .of("law", by_temperature);
        key.numbers("height_mm", oil.laws.height, Range::between(-1e4, 1e4),
                    "heights of the temperatures above the crank axis")
            .ascending()
            .needs("temperature_c");
        key.number("pressure_coefficient_1_gpa", oil.laws.pressure_coefficient,
                   Range::between(0.0, 100.0),
                   "alpha of exp(alpha p), the growth of the viscosity with pressure: 15 to 25 of "
                   "mineral oils; 0: none");
        key.number("shear_rate_1_s", oil.cross.rate, Range::between(1.0, 1e12),
                   "shear rate at which half of the part of polymers is left");
        key.number("shear_ratio", oil.cross.ratio, Range::between(0.0, 1.0),
                   "viscosity at the highest shear rates over that at rest: 0.4 to 0.8 of "
                   "multigrade oils")
            .of("shear_rate_1_s");
        key.number("shear_exponent", oil.cross.exponent, Range::between(0.1, 2.0),
                   "of the shear rate")
            .needs("shear_rate_1_s");
        key.check(check_oil);
      });
  return keys;
}

const keys::Keys<film::LinerLayerOptions>& liner_oil_keys() {
  static const keys::Keys<film::LinerLayerOptions> keys(
      "liner_oil", "the oil on the liner, remembered where the skirt leaves it",
      [](auto& key, film::LinerLayerOptions& layer) {
        key.number("cell_mm", layer.cell, Range::between(0.0, 100.0),
                   "height of its cells; 0: that of a row of the pad");
        key.number("splash_um_s", layer.splash, Range::between(0.0, 1e6),
                   "rate at which it thickens below the skirt");
        key.number("splash_thickness_um", layer.splash_thickness, kThicknessUm,
                   "thickness up to which it thickens by splash");
        key.number("most_um", layer.most, kThicknessUm,
                   "largest thickness below the skirt, more drips off; any without it");
        key.check([](const Config& table, film::LinerLayerOptions& found) {
          if (found.cell > 0.0 && found.cell < 0.01 * kMilli)
            table.fail("cell_mm", fmt::format("found {:g}, expected 0 (a row of the pad) or at "
                                              "least 0.01",
                                              found.cell / kMilli));
          if (found.splash > 0.0 && found.splash_thickness == 0.0)
            table.fail("splash_thickness_um", "is missing, splash_um_s above 0 needs it");
        });
      });
  return keys;
}

}  // namespace clatter::dynamics
