// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/registry.hpp"

#include "dynamics/chain/chain_component.hpp"
#include "dynamics/component/block_table.hpp"
#include "dynamics/component/body_component.hpp"
#include "dynamics/component/bushing_component.hpp"
#include "dynamics/component/drive_component.hpp"
#include "dynamics/component/engine_table.hpp"
#include "dynamics/component/gravity_component.hpp"
#include "dynamics/component/load_component.hpp"
#include "dynamics/component/mount_component.hpp"
#include "dynamics/component/rigid_body_component.hpp"
#include "dynamics/component/rolling_component.hpp"
#include "dynamics/component/spring_component.hpp"
#include "dynamics/component/stop_component.hpp"
#include "dynamics/crank/crank_component.hpp"
#include "dynamics/cylinder/contact_table.hpp"
#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/cylinder/cylinder_keys.hpp"
#include "dynamics/cylinder/rod_table.hpp"
#include "dynamics/hydraulic/hydraulic_component.hpp"
#include "dynamics/scene/time_table.hpp"
#include "dynamics/shaft/cam_torque_component.hpp"
#include "dynamics/shaft/shaft_component.hpp"
#include "dynamics/shaft/torque_component.hpp"
#include "dynamics/valve/follower_component.hpp"
#include "dynamics/valve/valve_component.hpp"
#include "dynamics/valve/valve_spring_component.hpp"

namespace clatter::dynamics {
namespace {

/// Keys of the scene itself.
struct SceneHead {
  std::filesystem::path base;
  std::string title;
  GravitySpec gravity;
};

const keys::Keys<SceneHead>& scene_head_keys() {
  static const keys::Keys<SceneHead> keys("run.toml", "a scene", [](auto& key, SceneHead& head) {
    key.path("base", head.base, "another run.toml, which has the keys that this one lacks");
    key.text("title", head.title, "in the run file and reports; the name of the file without it");
    key.part(head.gravity, gravity_keys());
  });
  return keys;
}

/// A kind of one table, whose meaning is the summary.
template <class S>
ComponentKind kind_of(const char* form, const keys::Keys<S>& keys,
                      ComponentList (*read)(const Config& root)) {
  return {{{form, &keys.table()}}, keys.table().meaning(), read};
}

keys::Table make_scene_table() {
  keys::Table table = scene_head_keys().table();
  const auto add = [&](const ComponentKind::Entry& entry) {
    if (entry.keys != nullptr)
      table.add(entry.name(), entry.form[1] == '[' ? keys::Type::kTables : keys::Type::kTable,
                *entry.keys);
  };
  add({"[time]", &time_keys().table()});
  add({"[accuracy]", &accuracy_keys().table()});
  for (const ComponentKind& kind : component_kinds())
    for (const ComponentKind::Entry& entry : kind.tables) add(entry);
  add({"[[recorded_force]]", &recorded_force_keys().table()});
  return table;
}

}  // namespace

std::string ComponentKind::Entry::name() const {
  const size_t brackets = form.find_first_not_of('[');
  return form.substr(brackets, form.size() - 2 * brackets);
}

const std::vector<ComponentKind>& component_kinds() {
  static const std::vector<ComponentKind> kinds{
      {{{"[engine]", &engine_keys().table()},
        {"[rod]", &rod_keys().table()},
        {"[piston]", &piston_keys().table()},
        {"[gas]", &gas_keys().table()},
        {"[contact]", &contact_keys().table()},
        {"[small_end]", &joint_table()},
        {"[big_end]", &joint_table()},
        {"[pin_guide]", &guide_keys().table()},
        {"[[cylinder]]", &cylinder_table()}},
       "slider-crank with piston, rod, joints, guide, skirt in its liner, gas",
       read_cylinders},
      {{{"[crank]", &crank_table()}}, crank_table().meaning(), read_crank},
      kind_of("[block]", block_keys(), read_block),
      kind_of("[[body]]", moving_body_keys(), read_bodies),
      kind_of("[[rigid_body]]", rigid_body_keys(), read_rigid_bodies),
      kind_of("[[shaft]]", shaft_keys(), read_shafts),
      kind_of("[[drive]]", drive_keys(), read_drives),
      {{{"[[chain]]", &chain_table()}}, chain_table().meaning(), read_chains},
      kind_of("[[mount]]", mount_keys(), read_mounts),
      kind_of("[[bushing]]", bushing_keys(), read_bushings),
      kind_of("[[spring]]", spring_keys(), read_springs),
      kind_of("[[tensioner]]", tensioner_keys(), read_tensioners),
      kind_of("[[lash_adjuster]]", lash_adjuster_keys(), read_lash_adjusters),
      kind_of("[[valve]]", valve_keys(), read_valves),
      kind_of("[[follower]]", follower_keys(), read_followers),
      kind_of("[[valve_spring]]", valve_spring_keys(), read_valve_springs),
      kind_of("[[torque]]", torque_keys(), read_torques),
      kind_of("[[cam_torque]]", cam_torque_keys(), read_cam_torques),
      kind_of("[[stop]]", stop_keys(), read_stops),
      kind_of("[[rolling_disc]]", rolling_disc_keys(), read_rolling_discs),
      {{{"gravity_m_s2"}}, gravity_keys().table().meaning(), read_gravity},
      kind_of("[[load]]", load_keys(), read_loads)};
  return kinds;
}

const keys::Table& scene_table() {
  static const keys::Table table = make_scene_table();
  return table;
}

void check_known(const Config& root) { scene_table().check_known(root); }

ComponentList read_components(const Config& root) {
  ComponentList components;
  for (const ComponentKind& kind : component_kinds())
    for (auto& component : kind.read(root)) components.push_back(std::move(component));
  return components;
}

}  // namespace clatter::dynamics
