// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/bushing_component.hpp"

#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/law/joint_laws.hpp"

namespace clatter::dynamics {

void BushingComponent::add_elements(ModelBuilder& model) {
  for (const BushingSpec& bushing : bushings_) {
    PairPorts ports = ports_of(bushing, model);
    auto law = bushing.law ? std::make_unique<RadialJoint>(*bushing.law)
                           : linear_joint(bushing.stiffness, bushing.damping);
    model.system.add_element(std::make_unique<PairElement>(bushing.name, std::move(ports.a),
                                                           std::move(ports.b), std::move(law)));
  }
}

std::vector<std::filesystem::path> BushingComponent::inputs() const {
  std::vector<std::filesystem::path> files;
  for (const BushingSpec& bushing : bushings_)
    if (bushing.law) files.push_back(bushing.table.file);
  return files;
}

void BushingComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (!bushings_.empty())
    effects.add(find_effect(kComponentEffects, "elastic joints"), true, "[[bushing]]", "bushing");
}

const Keys<BushingSpec>& bushing_keys() {
  static const Keys<BushingSpec> keys(
      "bushing", "a joint of two points with the elasticity of its bearing",
      [](auto& key, BushingSpec& bushing) {
        pair_rows(key, bushing);
        radial_table_rows(key, bushing.table);
        key.one_of({"stiffness_n_m", "table"});
        key.check([](const Config&, BushingSpec& found) {
          if (!found.table.file.empty()) found.law = read_radial_table(found.table, found.damping);
        });
      });
  return keys;
}

ComponentList read_bushings(const Config& root) {
  return {std::make_shared<BushingComponent>(read_elements(root, "bushing", bushing_keys()))};
}

}  // namespace clatter::dynamics
