// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The model of a scene: a system and the components that made it.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/component/component_interfaces.hpp"
#include "dynamics/given/crank_clock.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

struct Model {
  System system;
  std::optional<CrankClock> clock;  // of an engine scene
  EffectTable effects;
  /// Those of the scene, in its order, with what they added to the system.
  std::vector<std::unique_ptr<Component>> components;

  /// Histories of an accepted state, component by component.
  void record(const StageState& state, History& history) const;
};

/// Builds a new model from the data read; cheap compared with load_bodies. InputError for names
/// that are not in a reduced model and for inconsistent geometry. @param at_rest what is driven
/// rests where it is at the beginning.
std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& loaded,
                                   bool at_rest = false);

/// The components of class C, or with the interface C (component_interfaces.hpp).
template <class C>
std::vector<const C*> components_of(const Model& model) {
  std::vector<const C*> found;
  for (const auto& component : model.components)
    if (const auto* one = dynamic_cast<const C*>(component.get())) found.push_back(one);
  return found;
}

/// The contacts of pistons and liners, with the names of their components.
struct NamedContact {
  std::string name;
  const film::PistonLiner* contact;
};
std::vector<NamedContact> contacts_of(const Model& model);

}  // namespace clatter::dynamics
