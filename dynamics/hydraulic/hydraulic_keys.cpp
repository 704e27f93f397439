// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/hydraulic/hydraulic_component.hpp"

namespace clatter::dynamics {
namespace {

// The fluid's law needs a pressure above 0.
const Range kPressureBar = Range::between(1e-3, 1e4);
const Range kMillimetres = Range::between(1e-3, 1e3);
const Range kForce = Range::between(0.0, 1e6), kRate = Range::between(0.0, 1e12);

void check_valve_sizes(const Config& table, CheckValveSpec& valve) {
  if (valve.full_opening <= valve.opening)
    table.fail("full_opening_bar", fmt::format("found {:g}, expected more than opening_bar = {:g}",
                                               1e-5 * valve.full_opening, 1e-5 * valve.opening));
  if (valve.ball == CheckValveSpec::Ball::kMoving && valve.ball_diameter <= valve.seat_diameter)
    table.fail("ball_mm", fmt::format("found {:g}, expected more than the seat's {:g}",
                                      valve.ball_diameter / kMilli, valve.seat_diameter / kMilli));
}

const Keys<CheckValveSpec>& check_valve_keys() {
  using Ball = CheckValveSpec::Ball;
  static const Keys<CheckValveSpec> keys(
      "check_valve", "ball valve between supply and chamber", [](auto& key, CheckValveSpec& valve) {
        key.choice("ball", valve.ball,
                   {{"quasi_static", Ball::kQuasiStatic},
                    {"moving", Ball::kMoving},
                    {"stuck_shut", Ball::kStuckShut},
                    {"stuck_open", Ball::kStuckOpen}},
                   "without mass, with mass, or a defect");
        key.number("seat_mm", valve.seat_diameter, kMillimetres, "diameter of the seat");
        key.number("lift_mm", valve.lift, kMillimetres, "of the ball up to its stop");
        key.number("discharge", valve.discharge, Range::between(1e-3, 1.0),
                   "discharge coefficient of the opening, pi seat_mm times the lift");
        key.number("laminar_below_pa", valve.laminar, Range::between(1e-3, 1e6),
                   "pressure difference below which the flow is laminar");
        key.number("opening_bar", valve.opening, Range::between(0.0, 1e3),
                   "pressure difference at which a ball without mass begins to open");
        key.number("full_opening_bar", valve.full_opening, Range::between(1e-6, 1e3),
                   "pressure difference at which a ball without mass is open");
        key.all_need("ball", "moving", "", [&] {
          key.number("ball_mm", valve.ball_diameter, kMillimetres, "diameter of the ball");
          key.number("ball_density_kg_m3", valve.ball_density, Range::between(10.0, 3e4),
                     "density of the ball");
          key.number("spring_force_n", valve.spring_force, kForce,
                     "of the ball's spring on the seat");
          key.number("spring_rate_n_m", valve.spring_rate, kRate, "of the ball's spring");
          key.number("contact_stiffness_n_m", valve.contact_stiffness, Range::between(1.0, 1e15),
                     "of the ball with seat and stop");
          key.number(
              "contact_damping_s_m", valve.contact_damping, kForce,
              "of seat and stop: the force is times 1 + damping times the rate of the depth");
          key.number("drag_n_s_m", valve.drag, kForce, "of the oil round the ball");
        });
        key.check(check_valve_sizes);
      });
  return keys;
}

const Keys<ReliefSpec>& relief_keys() {
  static const Keys<ReliefSpec> keys(
      "relief", "valve that lets oil out of the chamber", [](auto& key, ReliefSpec& relief) {
        key.number("opening_bar", relief.opening, kPressureBar,
                   "pressure over that outside at which it opens")
            .required();
        key.number("gradient_ml_s_bar", relief.gradient, Range::between(1e-9, 1e9),
                   "flow over pressure difference above it")
            .required();
      });
  return keys;
}

/// What the sizes imply together: air in a dry chamber, and volumes that are left.
void check_volumes(const Config& table, HydraulicSpec& spec) {
  ChamberSpec& chamber = spec.chamber;
  if (chamber.dry) {
    chamber.oil = dry_air(chamber.oil.polytropic);
    spec.supply = {chamber.outside, {}, "", Spline::Kind::kLinear};
  }
  if (!(chamber.volume + chamber.area() * spec.travel > 0.0))
    table.fail("start_travel_mm", fmt::format("found {:g}, expected one that leaves a volume: "
                                              "travel 0 has {:g} cm3",
                                              spec.travel / kMilli, 1e6 * chamber.volume));
  if (!table.has("stops_mm")) return;
  const auto [lowest, highest] = spec.stops.ends;
  if (!(lowest <= spec.travel && spec.travel <= highest))
    table.fail("stops_mm",
               fmt::format("found [{:g}, {:g}], expected the ends of the travel, with the start "
                           "at {:g} between them",
                           lowest / kMilli, highest / kMilli, spec.travel / kMilli));
  if (!(chamber.volume + chamber.area() * lowest > 0.0))
    table.fail("stops_mm", fmt::format("found {:g}, expected a lowest travel that leaves a "
                                       "volume: travel 0 has {:g} cm3",
                                       lowest / kMilli, 1e6 * chamber.volume));
}

void add_oil(Keys<HydraulicSpec>& key, OilSpec& oil) {
  key.number("viscosity_mpa_s", oil.viscosity, Range::between(1e-3, 1e5),
             "dynamic viscosity of the oil");
  key.number("density_kg_m3", oil.density, Range::between(1.0, 2e4), "density of the oil at 1 bar");
  key.number("modulus_gpa", oil.modulus, Range::between(1e-3, 100.0),
             "bulk modulus of the oil without air");
  key.number("free_air", oil.free_air, Range::between(1e-5, 0.5),
             "volume of free air over that of oil, at 1 bar");
  key.number("polytropic_exponent", oil.polytropic, Range::between(1.0 + 1e-6, 2.0),
             "of the free air");
}

void add_supply(Keys<HydraulicSpec>& key, SupplySpec& supply) {
  key.number("supply_bar", supply.pressure, kPressureBar, "absolute pressure of the oil supply")
      .excludes("supply_table");
  key.path(
      "supply_table", supply.table,
      "CSV of the supply's pressure over time, with an engine or cycle_of over the crank angle");
  key.text("supply_column", supply.column, "column of the table; without it the second one")
      .needs("supply_table");
  interpolation_row(key, supply.interpolation).needs("supply_table");
}

void add_sizes(Keys<HydraulicSpec>& key, HydraulicSpec& spec) {
  ChamberSpec& chamber = spec.chamber;
  key.number("start_bar", spec.start_pressure, kPressureBar,
             "absolute pressure of the chamber at the start; that of the supply without it");
  key.number("diameter_mm", chamber.diameter, Range::between(1e-2, 1e4), "of the plunger");
  key.number("volume_cm3", chamber.volume, Range::between(1e-6, 1e9), "of the chamber at travel 0");
  key.number("outside_bar", chamber.outside, kPressureBar, "absolute pressure behind the plunger");
  key.number("spring_force_n", spec.spring.force, kForce, "of the plunger's spring at travel 0");
  key.number("spring_rate_n_m", spec.spring.rate, kRate, "of the plunger's spring");
  add_oil(key, chamber.oil);
  key.number("gap_um", chamber.leak.height, Range::between(0.0, 1e4),
             "radial leak gap round the plunger; 0: sealed");
  key.number("gap_length_mm", chamber.leak.length, Range::between(1e-3, 1e4), "of the leak gap");
  key.number("eccentricity", chamber.leak.eccentricity, Range::between(0.0, 1.0),
             "of the plunger in its housing, over the gap");
  key.choice("leak_to", chamber.leak.to_supply, {{"outside", false}, {"supply", true}},
             "where the leaked oil goes");
  add_supply(key, spec.supply);
  key.table("check_valve", chamber.valve, check_valve_keys());
  key.table("relief", chamber.relief, relief_keys());
  key.flag("dry", chamber.dry, "air instead of oil in chamber and supply");
  key.vector("stops_mm", spec.stops.ends, Range::between(-1e4, 1e4),
             "lowest and highest travel of the plunger; without them it is free");
  key.number("stop_stiffness_n_m", spec.stops.stiffness, Range::between(1.0, 1e15),
             "of both ends of the travel");
  key.check(check_volumes);
}

HydraulicSpec lash_adjuster_defaults() {
  HydraulicSpec spec;
  spec.kind = "lash_adjuster";
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

HydraulicSpec tensioner_defaults() {
  HydraulicSpec spec;
  spec.kind = "tensioner";
  return spec;
}

HydraulicSpec train_adjuster_defaults() {
  HydraulicSpec spec = lash_adjuster_defaults();
  spec.stops.ends = {-2e-3, 2e-3};
  return spec;
}

void add_plunger(Keys<HydraulicSpec>& key, HydraulicSpec& spec) {
  key.where(spec.where);
  name_row(key, spec.name).required();
  key.table("a", spec.a, point_keys(), "point of the housing").required();
  key.table("b", spec.b, point_keys(), "point of the plunger").required();
  key.direction("axis", spec.axis, "from the housing to the plunger, at the start").required();
  key.choice("model", spec.model,
             {{"hydraulic", HydraulicModel::kHydraulic},
              {"constant_pressure", HydraulicModel::kConstantPressure},
              {"constant_force", HydraulicModel::kConstantForce}},
             "of the oil: its content, the supply's pressure, or pressure and spring as at the "
             "start");
  key.number("start_travel_mm", spec.travel, Range::between(-1e4, 1e4),
             "travel of the plunger at the start");
  add_sizes(key, spec);
}

}  // namespace

const Keys<HydraulicSpec>& tensioner_keys() {
  static const Keys<HydraulicSpec> keys(
      "tensioner", "a plunger on an oil chamber with leak gap and check valve, and its spring",
      add_plunger, tensioner_defaults());
  return keys;
}

const Keys<HydraulicSpec>& lash_adjuster_keys() {
  static const Keys<HydraulicSpec> keys(
      "lash_adjuster", "the same with the sizes of a valve train's hydraulic lash adjuster",
      add_plunger, lash_adjuster_defaults());
  return keys;
}

const Keys<HydraulicSpec>& train_adjuster_keys() {
  static const Keys<HydraulicSpec> keys("lash_adjuster", "sizes of the lash adjuster of a valve",
                                        add_sizes, train_adjuster_defaults());
  return keys;
}

}  // namespace clatter::dynamics
