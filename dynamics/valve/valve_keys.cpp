// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/valve/valve_component.hpp"
#include "dynamics/valve/valve_spring_component.hpp"

namespace clatter::dynamics {
namespace {

/// Left of a spring until its coils touch when the valve is fully open [m].
constexpr double kReserve = 1.2e-3;

std::vector<ValveLobe> read_lobes(const Config& table) {
  std::vector<ValveLobe> lobes;
  std::set<std::string> names;
  for (const Config& one : table.tables("lobe")) {
    ValveLobe lobe{read_lobe(one, lobes.size() + 1), {}, {}, {}};
    if (!names.insert(lobe.name).second)
      one.fail("name",
               fmt::format("found \"{}\" a second time, expected each name once", lobe.name));
    for (const auto& [key, point] : {std::pair{"seat", &lobe.seat},
                                     {"spring_seat", &lobe.spring_seat},
                                     {"adjuster", &lobe.adjuster}})
      if (one.has(key) || one.has("on")) *point = read_point(one, one.has(key) ? key : "on");
    lobes.push_back(std::move(lobe));
  }
  if (lobes.empty()) table.fail("lobe", "found none, expected [[valve.lobe]] of each valve");
  return lobes;
}

void read_spring(const Config& table, ValveSpec& valve) {
  const auto own = table.find_table("spring");
  valve.spring = own ? read_coil_spring(*own) : CoilSpringSpec{};
  if ((own && own->has("to_solid_mm")) || !valve.cam.law) return;
  double highest = 0.0;
  for (int k = 0; k < 720; ++k)
    highest = std::max(highest, valve.cam.law->at(k * std::numbers::pi / 360.0).value);
  valve.spring.to_solid = highest + kReserve;
}

void read_adjuster(const Config& table, ValveSpec& valve) {
  valve.adjuster.stops.lowest = -2e-3;
  valve.adjuster.stops.highest = 2e-3;
  const auto own = table.find_table("lash_adjuster");
  if (!own) return;
  valve.hydraulic = own->choice("model", {"hydraulic", "rigid"}) == "hydraulic";
  if (own->has("axis")) {
    const std::vector<double> axis = own->numbers("axis", 2);
    valve.adjuster_axis = {axis[0], axis[1]};
    if (!(valve.adjuster_axis.norm() > 1e-6 && valve.adjuster_axis.norm() < 1e6))
      own->fail("axis", fmt::format("found length {:g}, expected a direction in the follower's "
                                    "plane",
                                    valve.adjuster_axis.norm()));
    valve.adjuster_axis.normalize();
  }
  if (!valve.hydraulic) return;
  valve.plunger_mass =
      own->number_or("plunger_mass_kg", valve.plunger_mass, Range::between(1e-9, 1e3));
  if (own->has("start_travel_mm"))
    own->fail("start_travel_mm", "found in a valve train, whose adjusters start at travel 0");
  read_hydraulic_sizes(*own, valve.adjuster);
}

}  // namespace

ValveSpec read_valve(const Config& table) {
  ValveSpec valve;
  valve.name = read_name(table);
  valve.where = table.where();
  const std::string model = table.choice("model", {"full", "quasi_static"});
  valve.model = model == "full" ? ValveModel::kFull : ValveModel::kQuasiStatic;
  valve.plane = read_follower_plane(table);
  valve.cam = read_cam(table);
  if (valve.model == ValveModel::kQuasiStatic && !valve.cam.law)
    table.fail("law", "found \"radius\" with model = \"quasi_static\", expected a lift law");
  valve.lobes = read_lobes(table);
  valve.mass = table.number_or("mass_kg", valve.mass, Range::between(1e-9, 1e4));
  if (const auto seat = table.find_table("seat")) {
    valve.seat_stiffness =
        seat->number_or("stiffness_n_m", valve.seat_stiffness, Range::between(1.0, 1e20));
    valve.seat_damping = seat->number_or("chi_s_m", valve.seat_damping, Range::between(0.0, 1e3));
  }
  if (const auto follower = table.find_table("follower")) read_follower(*follower, valve.follower);
  read_spring(table, valve);
  read_adjuster(table, valve);
  return valve;
}

ComponentList read_valves(const Config& root) {
  ComponentList valves;
  for (const Config& table : root.tables("valve"))
    valves.push_back(std::make_shared<ValveComponent>(read_valve(table)));
  return valves;
}

}  // namespace clatter::dynamics
