// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/shaft_component.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "dynamics/shaft/shaft_catalogue.hpp"

namespace clatter::dynamics {

bool ShaftComponent::has_wheel(size_t disc) const {
  return spec_.model != ShaftModel::kRigid && spec_.discs[disc].phaser;
}

ComponentTraits ShaftComponent::traits() const {
  if (spec_.model == ShaftModel::kRigid) return {.modes = 1};
  const int each = spec_.model == ShaftModel::kFull ? 6 : 1;
  int modes = each * static_cast<int>(shaft_stations(spec_).size());
  for (size_t d = 0; d < spec_.discs.size(); ++d) modes += has_wheel(d) ? 1 : 0;
  return {.modes = modes};
}

int ShaftComponent::add_body(ModelBuilder& model, const std::string& part,
                             const DiscInertia& inertia) const {
  const std::string name = part.empty() ? spec_.name : spec_.name + "." + part;
  ModalBody body = with_context(spec_.where, [&] {
    return bodies_.bends ? make_disc_body(name, inertia, spec_.axes, spec_.start)
                         : make_turning_body(name, inertia, spec_.axes, spec_.start);
  });
  body.displacement_scale = spec_.displacement_scale;
  body.velocity_scale = spec_.velocity_scale;
  return model.add_body(std::move(body), spec_.where);
}

void ShaftComponent::add_points(ModelBuilder& model, const std::string& part, size_t station,
                                const BodyDof& angle) const {
  const std::string name = spec_.name + "." + part;
  const auto port = [spec = spec_, centre = bodies_.stations[station].centre,
                     dofs = bodies_.coordinates(spec_, station, angle)](System& system,
                                                                        const Eigen::Vector3d& at) {
    return shaft_port(spec, centre, dofs, system, at);
  };
  model.add_ports(name, port, spec_.where);
  model.add_turn(name, {angle.body, angle.dof, spec_.axes.axis});
}

void ShaftComponent::add_bodies(ModelBuilder& model) {
  bodies_.stations = shaft_stations(spec_);
  bodies_.bends = spec_.model == ShaftModel::kFull;
  bodies_.wheel.assign(spec_.discs.size(), -1);
  if (spec_.model == ShaftModel::kRigid) {
    DiscInertia all;
    for (const ShaftStation& station : bodies_.stations) {
      all.mass += station.inertia.mass;
      all.polar += station.inertia.polar;
    }
    for (const ShaftDiscSpec& disc : spec_.discs)
      if (disc.phaser) all.polar += disc.inertia.polar;
    bodies_.body.assign(bodies_.stations.size(), add_body(model, "", all));
  } else {
    bodies_.body.clear();
    for (const ShaftStation& station : bodies_.stations)
      bodies_.body.push_back(add_body(model, station.name, station.inertia));
  }
  for (size_t d = 0; d < spec_.discs.size(); ++d) {
    const ShaftDiscSpec& disc = spec_.discs[d];
    const size_t station = station_of_disc(bodies_.stations, d);
    if (has_wheel(d)) {
      // What carries the wheel has its mass and tilts; its own body is the angle.
      DiscInertia inertia = disc.inertia;
      inertia.mass = bodies_.stations[station].inertia.mass;
      ModalBody wheel =
          make_turning_body(spec_.name + "." + disc.name, inertia, spec_.axes, spec_.start);
      wheel.displacement_scale = spec_.displacement_scale;
      wheel.velocity_scale = spec_.velocity_scale;
      bodies_.wheel[d] = model.add_body(std::move(wheel), spec_.where);
    }
    add_points(model, disc.name, station, bodies_.disc_angle(spec_, d));
  }
  for (size_t b = 0; b < spec_.bearings.size(); ++b) {
    const size_t station = station_of_bearing(bodies_.stations, b);
    add_points(model, spec_.bearings[b].name, station, bodies_.station_angle(spec_, station));
  }
}

void ShaftComponent::add_elements(ModelBuilder& model) {
  recorded_.clear();
  for (size_t d = 0; d < spec_.discs.size(); ++d) {
    const std::string name = spec_.name + "." + spec_.discs[d].name;
    const BodyDof angle = bodies_.disc_angle(spec_, d);
    const int y = model.system.coordinate(angle.body, angle.dof);
    recorded_.push_back({name + "_angle", "rad", y, false});
    recorded_.push_back({name + "_speed", "rad/s", y, true});
    const int body = bodies_.body[station_of_disc(bodies_.stations, d)];
    for (int k = 0; bodies_.bends && k < 3; ++k)
      recorded_.push_back({name + "_" + "xyz"[k], "m", model.system.coordinate(body, k), false});
  }
  add_shaft_elements(spec_, bodies_, model);
}

void ShaftComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  const size_t stations = bodies_.stations.size();
  const std::string what =
      bodies_.bends ? fmt::format("model = full, {} slices with 6 coordinates", stations)
      : spec_.model == ShaftModel::kTorsion
          ? fmt::format("model = torsion, {} slices with their angle", stations)
          : "model = rigid, one angle";
  effects.add(find_effect(kShaftEffects, "shaft"), "shaft " + spec_.name, true, what).unknowns =
      traits().modes;
}

void ShaftComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  const auto add = [&](const EffectEntry* entry, const char* what, bool on, const char* why,
                       const char* element) {
    effects.add(entry, spec_.name + " " + what, on, why, on ? element + (" " + spec_.name) : "");
  };
  const bool bends = bodies_.bends, rigid = spec_.model == ShaftModel::kRigid;
  effects.add(find_effect(kShaftEffects, "torsion of a shaft"), spec_.name + " torsion", !rigid,
              bends ? "with bending" : "model", bends || rigid ? "" : "torsion " + spec_.name);
  add(find_effect(kShaftEffects, "bending of a shaft"), "bending", bends, "model", "beam");
  add(find_effect(kShaftEffects, "gyroscopic moments of a shaft"), "gyroscopic moments", bends,
      "model", "gyroscope");
  if (!spec_.bearings.empty())
    add(find_effect(kShaftEffects, "bearings of a shaft"), "bearings", bends,
        bends ? "[[shaft.bearing]]" : "model: the axis is fixed", "bearing");
  bool phaser = false, unbalance = false;
  for (const ShaftDiscSpec& disc : spec_.discs) {
    phaser = phaser || disc.phaser;
    unbalance = unbalance || disc.unbalance > 0.0;
  }
  if (unbalance)
    add(find_effect(kShaftEffects, "unbalance of a disc"), "unbalance", true, "disc.unbalance_g_mm",
        "unbalance");
  if (phaser)
    add(find_effect(kShaftEffects, "phaser"), "phaser", !rigid,
        rigid ? "model = rigid" : "disc.phaser", "phaser");
}

void ShaftComponent::record(const System& system, const StageState& state, History& history) const {
  for (const Recorded& one : recorded_)
    history.put(one.name, one.unit, (one.rate ? state.v_y : state.y)(one.coordinate));
  Component::record(system, state, history);
}

ComponentList read_shafts(const Config& root) {
  ComponentList shafts;
  for (const Config& table : root.tables("shaft"))
    shafts.push_back(std::make_shared<ShaftComponent>(read_shaft(root, table)));
  return shafts;
}

}  // namespace clatter::dynamics
