// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/bushing_component.hpp"

#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/law_table.hpp"
#include "dynamics/force/port_element.hpp"
#include "dynamics/force/table_bushing.hpp"

namespace clatter::dynamics {

void BushingComponent::add_elements(ModelBuilder& model) {
  for (const BushingSpec& bushing : bushings_) {
    const PairSpec& pair = bushing.pair;
    PairPorts ports = ports_of(pair, model);
    if (bushing.law) {
      model.system.add_element(std::make_unique<TableBushing>(pair.name, std::move(ports.a),
                                                              std::move(ports.b), *bushing.law));
    } else {
      model.system.add_element(std::make_unique<Bushing>(
          pair.name, std::move(ports.a), std::move(ports.b), pair.stiffness, pair.damping));
    }
  }
}

std::vector<std::filesystem::path> BushingComponent::inputs() const {
  std::vector<std::filesystem::path> files;
  for (const BushingSpec& bushing : bushings_)
    files.insert(files.end(), bushing.files.begin(), bushing.files.end());
  return files;
}

void BushingComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (!bushings_.empty())
    effects.add(find_effect(kComponentEffects, "elastic joints"), true, "[[bushing]]", "bushing");
}

ComponentList read_bushings(const Config& root) {
  std::vector<BushingSpec> bushings;
  for (const Config& table : root.tables("bushing")) {
    const size_t number = bushings.size() + 1;
    BushingSpec& bushing = bushings.emplace_back();
    if (!table.has("table")) {
      bushing.pair = read_pair(table, "bushing", number);
      continue;
    }
    if (table.has("stiffness_n_m"))
      table.fail("stiffness_n_m", "found beside table, expected one of the two");
    bushing.pair = read_pair_points(table, "bushing", number);
    bushing.law = read_radial_table(table, 0.0, bushing.files);
  }
  return {std::make_shared<BushingComponent>(std::move(bushings))};
}

}  // namespace clatter::dynamics
