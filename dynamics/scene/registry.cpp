// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/registry.hpp"

#include "dynamics/chain/chain_component.hpp"
#include "dynamics/component/body_component.hpp"
#include "dynamics/component/bushing_component.hpp"
#include "dynamics/component/drive_component.hpp"
#include "dynamics/component/gravity_component.hpp"
#include "dynamics/component/load_component.hpp"
#include "dynamics/component/mount_component.hpp"
#include "dynamics/component/rigid_body_component.hpp"
#include "dynamics/component/spring_component.hpp"
#include "dynamics/component/stop_component.hpp"
#include "dynamics/crank/crank_component.hpp"
#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/hydraulic/hydraulic_component.hpp"
#include "dynamics/shaft/cam_torque_component.hpp"
#include "dynamics/shaft/shaft_component.hpp"
#include "dynamics/shaft/torque_component.hpp"
#include "dynamics/valve/follower_component.hpp"
#include "dynamics/valve/valve_component.hpp"
#include "dynamics/valve/valve_spring_component.hpp"

namespace clatter::dynamics {
namespace {

/// "body" of "[[body]]".
std::string key_of(const std::string& table) {
  const size_t brackets = table.find_first_not_of('[');
  return table.substr(brackets, table.size() - 2 * brackets);
}

}  // namespace

const std::vector<ComponentKind>& component_kinds() {
  static const std::vector<ComponentKind> kinds{
      {{"[engine]", "[rod]", "[piston]", "[gas]", "[contact]", "[small_end]", "[big_end]",
        "[pin_guide]", "[[cylinder]]"},
       "slider-crank with piston, rod, joints, guide, skirt in its liner, gas",
       read_cylinders},
      {{"[crank]"},
       "the crankshaft as a body in main bearings, its rotation prescribed or free",
       read_crank},
      {{"[block]"}, "the engine block, a reduced part; rigid: the ground", read_block},
      {{"[[body]]"},
       "a reduced part whose frame is at rest, moves in space, or turns with a drive",
       read_bodies},
      {{"[[rigid_body]]"},
       "a rigid body with large motion, in a plane or in space",
       read_rigid_bodies},
      {{"[[shaft]]"}, "an elastic shaft with discs in journal bearings: camshafts", read_shafts},
      {{"[[drive]]"}, "a shaft that turns as prescribed", read_drives},
      {{"[[chain]]"},
       "a chain of links that runs over sprockets and guides, closed and set in equilibrium",
       read_chains},
      {{"[[mount]]"},
       "springs and dampers between nodes of a reduced part and the ground",
       read_mounts},
      {{"[[bushing]]"}, "a joint of two points with the elasticity of its bearing", read_bushings},
      {{"[[spring]]"}, "a spring and damper along the line between two points", read_springs},
      {{"[[tensioner]]"},
       "a plunger on an oil chamber with leak gap and check valve, and its spring",
       read_tensioners},
      {{"[[lash_adjuster]]"},
       "the same with the sizes of a valve train's hydraulic lash adjuster",
       read_lash_adjusters},
      {{"[[valve]]"},
       "valves of a camshaft: seat, spring, finger follower, lash adjuster, or their torque",
       read_valves},
      {{"[[follower]]"}, "a roller finger follower between a cam and a valve", read_followers},
      {{"[[valve_spring]]"},
       "a coil spring as masses between springs, whose coils may touch",
       read_valve_springs},
      {{"[[torque]]"}, "a torque over the angle of the body on which it acts", read_torques},
      {{"[[cam_torque]]"}, "the torque of valves on their cams, quasi-static", read_cam_torques},
      {{"[[stop]]"}, "contact of a point with a plane, rigid by impacts or compliant", read_stops},
      {{"gravity_m_s2"}, "the weight of all bodies, along -z", read_gravity},
      {{"[[load]]"}, "a known force over time or crank angle", read_loads}};
  return kinds;
}

void check_known(const Config& root) {
  for (const char* key : {"title", "time", "accuracy", "recorded_force"})
    static_cast<void>(root.has(key));
  for (const ComponentKind& kind : component_kinds())
    for (const std::string& table : kind.tables) static_cast<void>(root.has(key_of(table)));
  root.finish_table();
}

ComponentList read_components(const Config& root) {
  ComponentList components;
  for (const ComponentKind& kind : component_kinds())
    for (auto& component : kind.read(root)) components.push_back(std::move(component));
  return components;
}

}  // namespace clatter::dynamics
