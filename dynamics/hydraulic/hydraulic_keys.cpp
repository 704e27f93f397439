// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/hydraulic/hydraulic_component.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kBar = 1e5, kGiga = 1e9;
// The fluid's law needs a pressure above 0.
const Range kPressureBar = Range::between(1e-3, 1e4);

/// A key of `unit` SI units with a default in SI.
void read_value(const Config& table, std::string_view key, double unit, const Range& range,
                double& value) {
  value = table.number_or(key, value / unit, range) * unit;
}

void read_oil(const Config& table, OilSpec& oil) {
  read_value(table, "viscosity_mpa_s", kMilli, Range::between(1e-3, 1e5), oil.viscosity);
  read_value(table, "density_kg_m3", 1.0, Range::between(1.0, 2e4), oil.density);
  read_value(table, "modulus_gpa", kGiga, Range::between(1e-3, 100.0), oil.modulus);
  read_value(table, "free_air", 1.0, Range::between(1e-5, 0.5), oil.free_air);
  read_value(table, "polytropic_exponent", 1.0, Range::between(1.0 + 1e-6, 2.0), oil.polytropic);
}

void read_leak(const Config& table, LeakGap& leak) {
  read_value(table, "gap_um", kMicro, Range::between(0.0, 1e4), leak.height);
  read_value(table, "gap_length_mm", kMilli, Range::between(1e-3, 1e4), leak.length);
  read_value(table, "eccentricity", 1.0, Range::between(0.0, 1.0), leak.eccentricity);
  leak.to_supply = table.choice("leak_to", {"outside", "supply"}) == "supply";
}

void read_ball(const Config& table, CheckValveSpec& valve) {
  const Range millimetres = Range::between(1e-3, 1e3);
  const Range force = Range::between(0.0, 1e6), rate = Range::between(0.0, 1e12);
  read_value(table, "ball_mm", kMilli, millimetres, valve.ball_diameter);
  read_value(table, "ball_density_kg_m3", 1.0, Range::between(10.0, 3e4), valve.ball_density);
  read_value(table, "spring_force_n", 1.0, force, valve.spring_force);
  read_value(table, "spring_rate_n_m", 1.0, rate, valve.spring_rate);
  read_value(table, "contact_stiffness_n_m", 1.0, Range::between(1.0, 1e15),
             valve.contact_stiffness);
  read_value(table, "contact_damping_s_m", 1.0, Range::between(0.0, 1e6), valve.contact_damping);
  read_value(table, "drag_n_s_m", 1.0, Range::between(0.0, 1e6), valve.drag);
  if (valve.ball_diameter <= valve.seat_diameter)
    table.fail("ball_mm", fmt::format("found {:g}, expected more than the seat's {:g}",
                                      valve.ball_diameter / kMilli, valve.seat_diameter / kMilli));
}

void read_check_valve(const Config& table, CheckValveSpec& valve) {
  using Ball = CheckValveSpec::Ball;
  const std::string ball =
      table.choice("ball", {"quasi_static", "moving", "stuck_shut", "stuck_open"});
  valve.ball = ball == "moving"       ? Ball::kMoving
               : ball == "stuck_shut" ? Ball::kStuckShut
               : ball == "stuck_open" ? Ball::kStuckOpen
                                      : Ball::kQuasiStatic;
  const Range millimetres = Range::between(1e-3, 1e3);
  read_value(table, "seat_mm", kMilli, millimetres, valve.seat_diameter);
  read_value(table, "lift_mm", kMilli, millimetres, valve.lift);
  read_value(table, "discharge", 1.0, Range::between(1e-3, 1.0), valve.discharge);
  read_value(table, "laminar_below_pa", 1.0, Range::between(1e-3, 1e6), valve.laminar);
  read_value(table, "opening_bar", kBar, Range::between(0.0, 1e3), valve.opening);
  read_value(table, "full_opening_bar", kBar, Range::between(1e-6, 1e3), valve.full_opening);
  if (valve.full_opening <= valve.opening)
    table.fail("full_opening_bar", fmt::format("found {:g}, expected more than opening_bar = {:g}",
                                               valve.full_opening / kBar, valve.opening / kBar));
  if (valve.ball == Ball::kMoving) read_ball(table, valve);
}

void read_supply(const Config& table, SupplySpec& supply) {
  if (!table.has("supply_table")) {
    read_value(table, "supply_bar", kBar, kPressureBar, supply.pressure);
    return;
  }
  supply.table = table.path("supply_table");
  supply.column = table.text_or("supply_column", "");
  supply.interpolation = read_interpolation(table, "linear");
}

HydraulicModel read_model(const Config& table) {
  const std::string model =
      table.choice("model", {"hydraulic", "constant_pressure", "constant_force"});
  if (model == "constant_pressure") return HydraulicModel::kConstantPressure;
  if (model == "constant_force") return HydraulicModel::kConstantForce;
  return HydraulicModel::kHydraulic;
}

/// Both ends of the travel, of which the lower one leaves a volume.
void read_stops(const Config& table, HydraulicSpec& spec) {
  PlungerStops& stops = spec.stops;
  if (table.has("stops_mm")) {
    const std::vector<double> ends = table.numbers("stops_mm", 2);
    stops.lowest = ends[0] * kMilli;
    stops.highest = ends[1] * kMilli;
    if (!(stops.lowest <= spec.travel && spec.travel <= stops.highest && ends[1] <= 1e4))
      table.fail("stops_mm",
                 fmt::format("found [{:g}, {:g}], expected the ends of the travel, with the start "
                             "at {:g} between them",
                             ends[0], ends[1], spec.travel / kMilli));
    if (!(spec.chamber.volume + spec.chamber.area() * stops.lowest > 0.0))
      table.fail("stops_mm", fmt::format("found {:g}, expected a lowest travel that leaves a "
                                         "volume: travel 0 has {:g} cm3",
                                         ends[0], 1e6 * spec.chamber.volume));
  }
  read_value(table, "stop_stiffness_n_m", 1.0, Range::between(1.0, 1e15), stops.stiffness);
}

}  // namespace

HydraulicSpec lash_adjuster_defaults() {
  HydraulicSpec spec;
  spec.spring = {12.0, 0.0};
  ChamberSpec& chamber = spec.chamber;
  chamber.diameter = 9e-3;
  chamber.volume = 150e-9;
  chamber.leak.height = 7e-6;
  chamber.leak.length = 12e-3;
  chamber.valve.seat_diameter = 2e-3;
  chamber.valve.lift = 0.15e-3;
  chamber.valve.ball_diameter = 3e-3;
  return spec;
}

void read_hydraulic_sizes(const Config& table, HydraulicSpec& spec) {
  const Range force = Range::between(0.0, 1e6), rate = Range::between(0.0, 1e12);
  ChamberSpec& chamber = spec.chamber;
  read_value(table, "start_travel_mm", kMilli, Range::between(-1e4, 1e4), spec.travel);
  if (table.has("start_bar")) spec.start_pressure = table.number("start_bar", kPressureBar) * kBar;
  read_value(table, "diameter_mm", kMilli, Range::between(1e-2, 1e4), chamber.diameter);
  read_value(table, "volume_cm3", 1e-6, Range::between(1e-6, 1e9), chamber.volume);
  read_value(table, "outside_bar", kBar, kPressureBar, chamber.outside);
  read_value(table, "spring_force_n", 1.0, force, spec.spring.force);
  read_value(table, "spring_rate_n_m", 1.0, rate, spec.spring.rate);
  read_oil(table, chamber.oil);
  read_leak(table, chamber.leak);
  read_supply(table, spec.supply);
  if (const auto valve = table.find_table("check_valve")) read_check_valve(*valve, chamber.valve);
  if (const auto relief = table.find_table("relief")) {
    chamber.relief.opening = relief->number("opening_bar", kPressureBar) * kBar;
    chamber.relief.gradient =
        relief->number("gradient_ml_s_bar", Range::between(1e-9, 1e9)) * 1e-6 / kBar;
  }
  chamber.dry = table.flag_or("dry", false);
  if (chamber.dry) {
    chamber.oil = dry_air(chamber.oil.polytropic);
    spec.supply = {chamber.outside, {}, "", Spline::Kind::kLinear};
  }
  if (!(chamber.volume + chamber.area() * spec.travel > 0.0))
    table.fail("start_travel_mm", fmt::format("found {:g}, expected one that leaves a volume: "
                                              "travel 0 has {:g} cm3",
                                              spec.travel / kMilli, 1e6 * chamber.volume));
  read_stops(table, spec);
}

HydraulicSpec read_hydraulic(const Config& table, HydraulicSpec spec) {
  spec.name = read_name(table);
  spec.where = table.where();
  spec.a = read_point(table, "a");
  spec.b = read_point(table, "b");
  spec.axis = read_direction(table, "axis");
  spec.model = read_model(table);
  read_hydraulic_sizes(table, spec);
  return spec;
}

}  // namespace clatter::dynamics
