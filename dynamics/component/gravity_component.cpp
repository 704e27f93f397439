// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/gravity_component.hpp"

#include <Eigen/Geometry>

#include "dynamics/component/model_builder.hpp"

namespace clatter::dynamics {

void GravityComponent::add_loads(ModelBuilder& model) {
  if (gravity_ <= 0.0) return;
  for (const auto& [name, body] : model.bodies()) {
    const LoadedBody* loaded = find_body(model.loaded, name);
    const Shaft* shaft = loaded == nullptr ? nullptr : model.shaft_of(loaded->spec);
    if (shaft == nullptr) {
      model.system.add_load({"gravity", body, frame_force(model.system, body, 2),
                             ramped(model.time, [g = gravity_](double) { return g; })});
      continue;
    }
    // Of the axes of a frame that turns, the vertical has components that change.
    const double begin = shaft->drive.at(model.time.begin).position;
    for (int k = 0; k < 3; ++k) {
      const auto along = [g = gravity_, k, begin, shaft = *shaft](double t) {
        const Eigen::AngleAxisd turn(shaft.drive.at(t).position - begin, shaft.axis);
        return g * (turn * Eigen::Vector3d::Unit(k)).z();
      };
      model.system.add_load(
          {"gravity", body, frame_force(model.system, body, k), ramped(model.time, along)});
    }
  }
}

void GravityComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  effects.add("gravity", gravity_ > 0.0, "gravity_m_s2");
}

ComponentList read_gravity(const Config& root) {
  const double gravity = root.number_or("gravity_m_s2", 0.0, Range::between(0.0, 1e5));
  return {std::make_shared<GravityComponent>(gravity)};
}

}  // namespace clatter::dynamics
