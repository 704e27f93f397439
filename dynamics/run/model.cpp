// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model.hpp"

#include "dynamics/component/model_builder.hpp"

namespace clatter::dynamics {

std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& loaded, bool at_rest) {
  auto model = std::make_unique<Model>();
  for (const auto& component : scene.components) model->components.push_back(component->clone());
  const auto& components = model->components;
  ModelBuilder builder(loaded, scene.time, scene.clock);
  builder.at_rest = at_rest;
  for (const auto& component : components) component->add_bodies(builder);
  for (const auto& component : components) {
    const int first = builder.system.elements();
    component->add_elements(builder);
    component->set_elements({first, builder.system.elements()});
  }
  for (const auto& component : components) component->add_loads(builder);
  for (const auto& component : components) component->add_body_effects(builder, model->effects);
  for (const auto& component : components) component->add_effects(builder, model->effects);
  model->system = std::move(builder.system);
  model->clock = scene.clock;
  return model;
}

void Model::record(const StageState& state, History& history) const {
  for (const auto& component : components) component->record(system, state, history);
}

std::vector<NamedContact> contacts_of(const Model& model) {
  std::vector<NamedContact> found;
  for (const auto& component : model.components) {
    const auto* piston = dynamic_cast<const PistonInLiner*>(component.get());
    if (piston != nullptr && piston->contact() != nullptr)
      found.push_back({component->name(), piston->contact()});
  }
  return found;
}

}  // namespace clatter::dynamics
