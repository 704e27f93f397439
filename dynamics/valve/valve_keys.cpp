// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "dynamics/component/component_keys.hpp"
#include "dynamics/valve/valve_component.hpp"

namespace clatter::dynamics {
namespace {

/// Left of a spring until its coils touch when the valve is fully open [m].
constexpr double kReserve = 1.2e-3;

const Keys<ValveLobe>& valve_lobe_keys() {
  static const Keys<ValveLobe> keys("lobe", "a cam with its valve", [](auto& key, ValveLobe& lobe) {
    key.part(static_cast<LobeSpec&>(lobe), lobe_keys());
    key.table("on", lobe.on, point_keys(),
              "what carries seat, spring seat and adjuster; without it the ground");
    key.table("seat", lobe.seat, point_keys(), "what carries the seat, instead of on");
    key.table("spring_seat", lobe.spring_seat, point_keys(),
              "what carries the spring, instead of on");
    key.table("adjuster", lobe.adjuster, point_keys(), "what carries the adjuster, instead of on");
    key.check([](const Config& table, ValveLobe& found) {
      if (!table.has("seat")) found.seat = found.on;
      if (!table.has("spring_seat")) found.spring_seat = found.on;
      if (!table.has("adjuster")) found.adjuster = found.on;
    });
  });
  return keys;
}

const Keys<ValveSeatSpec>& seat_keys() {
  static const Keys<ValveSeatSpec> keys(
      "seat", "the seat of a valve", [](auto& key, ValveSeatSpec& seat) {
        key.number("stiffness_n_m", seat.stiffness, Range::between(1.0, 1e20), "of the contact");
        key.number("chi_s_m", seat.damping, Range::between(0.0, 1e3),
                   "damping: the force is times 1 + chi rate");
      });
  return keys;
}

void check_train_adjuster(const Config& table, TrainAdjusterSpec& found) {
  if (!found.is_hydraulic)
    for (const keys::Key& key : train_adjuster_keys().table().keys())
      if (table.has(key.name)) table.fail(key.name, "needs model = \"hydraulic\"");
  const double length = found.axis.norm();
  if (!(length > 1e-6))
    table.fail("axis", fmt::format("found length {:g}, expected a direction in the follower's "
                                   "plane",
                                   length));
  found.axis.normalize();
}

const Keys<TrainAdjusterSpec>& adjuster_keys() {
  static const Keys<TrainAdjusterSpec> keys(
      "lash_adjuster", "the lash adjuster of a valve", [](auto& key, TrainAdjusterSpec& adjuster) {
        key.choice("model", adjuster.is_hydraulic, {{"hydraulic", true}, {"rigid", false}},
                   "rigid: the follower's ball does not move");
        key.vector("axis", adjuster.axis, Range::between(-1e6, 1e6),
                   "direction out of the housing, in the follower's plane");
        key.number("plunger_mass_kg", adjuster.plunger_mass, Range::between(1e-9, 1e3),
                   "mass of the plunger")
            .needs("model", "hydraulic");
        key.part(adjuster.sizes, train_adjuster_keys());
        key.check(check_train_adjuster);
      });
  return keys;
}

void check_valve(const Config& table, ValveSpec& valve) {
  valve.cam = make_cam(valve.law);
  if (valve.model == ValveModel::kQuasiStatic && !valve.cam.law)
    table.fail("law", "found \"radius\" with model = \"quasi_static\", expected a lift law");
  std::map<std::string, std::string> names;
  const std::vector<Config> lobes = table.tables("lobe");
  for (size_t k = 0; k < lobes.size(); ++k) {
    std::string& name = valve.lobes[k].name;
    if (name.empty()) name = std::to_string(k + 1);
    check_new_name(lobes[k], "lobe", name, names);
  }
  const auto spring = table.find_table("spring");
  if ((spring && spring->has("to_solid_mm")) || !valve.cam.law) return;
  double highest = 0.0;
  for (int k = 0; k < 720; ++k)
    highest = std::max(highest, valve.cam.law->at(k * std::numbers::pi / 360.0).value);
  valve.coil.spring.to_solid = highest + kReserve;
}

}  // namespace

const Keys<ValveSpec>& valve_keys() {
  static const Keys<ValveSpec> keys(
      "valve",
      "valves of a camshaft: seat, spring, finger follower, lash adjuster, or their torque",
      [](auto& key, ValveSpec& valve) {
        key.where(valve.where);
        name_row(key, valve.name).required();
        key.choice("model", valve.model,
                   {{"full", ValveModel::kFull}, {"quasi_static", ValveModel::kQuasiStatic}},
                   "bodies and contacts, or the torque on the cam by the lift law");
        key.part(valve.plane, follower_plane_keys());
        cam_rows(key, valve.law);
        key.number("mass_kg", valve.mass, Range::between(1e-9, 1e4),
                   "of a valve with its retainer");
        key.tables("lobe", valve.lobes, valve_lobe_keys()).required();
        key.table("seat", valve.seat, seat_keys());
        key.table("spring", valve.coil, coil_spring_keys());
        key.table("follower", valve.follower, follower_spec_keys());
        key.table("lash_adjuster", valve.adjuster, adjuster_keys());
        key.check(check_valve);
      });
  return keys;
}

ComponentList read_valves(const Config& root) {
  ComponentList valves;
  for (const Config& table : root.tables("valve"))
    valves.push_back(std::make_shared<ValveComponent>(valve_keys().read(table)));
  return valves;
}

}  // namespace clatter::dynamics
