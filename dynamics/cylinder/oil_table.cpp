// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/oil_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kCelsius = 273.15;                  // 0 degrees [K]
const Range kAnyHeight = Range::between(-1e4, 1e4);  // [mm]

void read_vogel(const Config& oil, film::ViscosityOptions& laws) {
  laws.vogel = {.a = oil.number("vogel_a_pa_s", Range::between(1e-9, 1.0)),
                .b = oil.number("vogel_b_k", Range::between(0.0, 1e4)),
                .c = oil.number("vogel_c_c", Range::between(-270.0, 50.0)) + kCelsius};
}

void read_walther(const Config& oil, film::ViscosityOptions& laws) {
  const auto temperature = oil.numbers("walther_temperature_c", 2),
             kinematic = oil.numbers("walther_mm2_s", 2);
  if (!(temperature[0] >= -60.0 && temperature[1] > temperature[0] && temperature[1] <= 400.0))
    oil.fail("walther_temperature_c", fmt::format("found {:g} and {:g}, expected two ascending "
                                                  "temperatures from -60 to 400",
                                                  temperature[0], temperature[1]));
  if (!(kinematic[1] >= 0.5 && kinematic[0] > kinematic[1] && kinematic[0] <= 1e6))
    oil.fail(
        "walther_mm2_s",
        fmt::format("found {:g} and {:g}, expected two descending viscosities from 1e+06 to 0.5",
                    kinematic[0], kinematic[1]));
  laws.walther = {.temperature = {temperature[0] + kCelsius, temperature[1] + kCelsius},
                  .kinematic = {kinematic[0] * 1e-6, kinematic[1] * 1e-6},
                  .density = oil.number("density_kg_m3", Range::between(100.0, 5000.0))};
}

// One temperature, or one at each of ascending heights.
void read_temperature(const Config& oil, film::ViscosityOptions& laws) {
  const auto celsius = oil.is_list("temperature_c")
                           ? oil.numbers("temperature_c")
                           : std::vector<double>{oil.number("temperature_c")};
  for (const double value : celsius)
    if (!(value >= -60.0 && value <= 400.0))
      oil.fail("temperature_c", fmt::format("found {:g}, expected -60 to 400", value));
  const auto heights = oil.numbers_or("height_mm", {});
  if (celsius.empty() || heights.size() != (celsius.size() > 1 ? celsius.size() : 0))
    oil.fail("height_mm",
             fmt::format("found {} heights for {} temperatures, expected as many, none "
                         "for one temperature",
                         heights.size(), celsius.size()));
  for (size_t k = 0; k < heights.size(); ++k)
    if (!(std::abs(heights[k]) <= kAnyHeight.max) || (k > 0 && !(heights[k] > heights[k - 1])))
      oil.fail(
          "height_mm",
          fmt::format("found {:g}, expected ascending heights from -1e+04 to 1e+04", heights[k]));
  for (const double height : heights) laws.height.push_back(height * kMilli);
  for (const double value : celsius) laws.temperature.push_back(value + kCelsius);
}

}  // namespace

void read_viscosity(const Config& table, film::PistonLinerOptions& options) {
  const auto oil = table.find_table("oil");
  if (!oil) return;
  film::ViscosityOptions& laws = options.oil;
  const std::string law = oil->choice("law", {"constant", "vogel", "walther"});
  if (law == "vogel") read_vogel(*oil, laws);
  if (law == "walther") read_walther(*oil, laws);
  if (laws.by_temperature()) read_temperature(*oil, laws);
  laws.pressure_coefficient =
      oil->number_or("pressure_coefficient_1_gpa", 0.0, Range::between(0.0, 100.0)) * 1e-9;
  if (oil->has("shear_rate_1_s"))
    laws.cross = {.rate = oil->number("shear_rate_1_s", Range::between(1.0, 1e12)),
                  .ratio = oil->number("shear_ratio", Range::between(0.0, 1.0)),
                  .exponent = oil->number_or("shear_exponent", 1.0, Range::between(0.1, 2.0))};
  with_context(oil->where(), [&] { film::Viscosity{laws, options.viscosity}; });
}

void read_liner_oil(const Config& table, film::PistonLinerOptions& options) {
  const auto oil = table.find_table("liner_oil");
  if (!oil) return;
  if (!options.effects.film || !options.effects.cavitation)
    table.fail("liner_oil",
               "found it without a film that cavitates, expected lubrication = "
               "\"film\" and cavitation = true");
  if (!table.has("oil_thickness_um"))
    table.fail("oil_thickness_um",
               "found none beside contact.liner_oil, expected the layer on the liner at the start");
  if (options.supply_pressure > 0.0 || options.supply_fill < 1.0)
    table.fail(options.supply_pressure > 0.0 ? "supply_pressure_bar" : "supply_fill",
               "found beside contact.liner_oil, which supplies the skirt; expected one of the two");
  if (oil->has("ring"))
    oil->fail("ring", "found here, expected [[contact.ring]]: a ring has friction as well");
  film::LinerLayerOptions& layer = options.liner_layer.emplace();
  layer.cell = oil->number_or("cell_mm", 0.0, Range::between(0.0, 100.0)) * kMilli;
  if (layer.cell > 0.0 && layer.cell < 0.01 * kMilli)
    oil->fail("cell_mm", fmt::format("found {:g}, expected 0 (a row of the pad) or at least 0.01",
                                     layer.cell / kMilli));
  const double length = options.skirt_top - options.skirt_bottom;
  if (2.0 * layer.cell > length)
    oil->fail("cell_mm",
              fmt::format("found {:g}, expected at most half of the skirt's length, {:g}",
                          layer.cell / kMilli, 0.5 * length / kMilli));
  layer.splash = oil->number_or("splash_um_s", 0.0, Range::between(0.0, 1e6)) * kMicro;
  if (layer.splash > 0.0)
    layer.splash_thickness = oil->number("splash_thickness_um", Range::between(1e-3, 1e5)) * kMicro;
  if (oil->has("most_um")) layer.most = oil->number("most_um", Range::between(1e-3, 1e5)) * kMicro;
}

}  // namespace clatter::dynamics
