// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/bushing_component.hpp"

#include "dynamics/force/port_element.hpp"

namespace clatter::dynamics {

void BushingComponent::add_elements(ModelBuilder& model) {
  for (const PairSpec& pair : pairs_) {
    PairPorts ports = ports_of(pair, model);
    model.system.add_element(std::make_unique<Bushing>(
        pair.name, std::move(ports.a), std::move(ports.b), pair.stiffness, pair.damping));
  }
}

void BushingComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (!pairs_.empty()) effects.add("elastic joints", true, "[[bushing]]", "bushing");
}

ComponentList read_bushings(const Config& root) {
  std::vector<PairSpec> pairs;
  for (const Config& table : root.tables("bushing"))
    pairs.push_back(read_pair(table, "bushing", pairs.size() + 1));
  return {std::make_shared<BushingComponent>(std::move(pairs))};
}

}  // namespace clatter::dynamics
