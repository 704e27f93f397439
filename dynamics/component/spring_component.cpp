// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/spring_component.hpp"

#include "core/base/error.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"

namespace clatter::dynamics {

void SpringComponent::add_elements(ModelBuilder& model) {
  for (const SpringSpec& spring : springs_) {
    const Eigen::Vector3d from = model.position(spring.a, std::nullopt);
    if ((model.position(spring.b, from) - from).norm() < 1e-9)
      throw InputError(spring.b.where +
                       ": is the same point as a, expected another one: the spring acts along the "
                       "line between them");
    PairPorts ports = ports_of(spring, model);
    model.system.add_element(std::make_unique<PairElement>(
        spring.name, std::move(ports.a), std::move(ports.b),
        std::make_unique<LineSpring>(spring.stiffness, spring.damping, spring.length)));
  }
}

void SpringComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (!springs_.empty())
    effects.add(find_effect(kComponentEffects, "springs"), true, "[[spring]]", "spring");
}

const Keys<SpringSpec>& spring_keys() {
  static const Keys<SpringSpec> keys(
      "spring", "a spring and damper along the line between two points",
      [](auto& key, SpringSpec& spring) {
        pair_rows(key, spring).required();
        key.number("length_mm", spring.length, Range::between(0.0, 1e6), "without force")
            .required();
      });
  return keys;
}

ComponentList read_springs(const Config& root) {
  return {std::make_shared<SpringComponent>(read_elements(root, "spring", spring_keys()))};
}

}  // namespace clatter::dynamics
