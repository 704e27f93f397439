// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/gravity_component.hpp"

#include "dynamics/component/model_builder.hpp"

namespace clatter::dynamics {

void GravityComponent::add_loads(ModelBuilder& model) {
  if (gravity_ <= 0.0) return;
  for (const auto& [name, body] : model.bodies())
    model.system.add_load({"gravity", body, frame_force(model.system, body, 2),
                           ramped(model.time, [g = gravity_](double) { return g; })});
}

void GravityComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  effects.add("gravity", gravity_ > 0.0, "gravity_m_s2");
}

ComponentList read_gravity(const Config& root) {
  const double gravity = root.number_or("gravity_m_s2", 0.0, Range::between(0.0, 1e5));
  return {std::make_shared<GravityComponent>(gravity)};
}

}  // namespace clatter::dynamics
