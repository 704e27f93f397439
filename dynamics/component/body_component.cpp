// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/body_component.hpp"

#include <fmt/format.h>

#include <cmath>

#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

std::string body_size(const LoadedBody& body) {
  return fmt::format("{} coordinates, {} rigid modes, highest {:.4g} Hz", body.model.size(),
                     body.modal.rigid_modes,
                     std::sqrt(body.modal.omega_squared.maxCoeff()) / 6.283185307179586);
}

}  // namespace

void add_body_effect(const LoadedBody& body, EffectTable& effects) {
  const BodySpec& spec = body.spec;
  effects.add(fmt::format("elastic {}", spec.name), spec.elastic,
              spec.elastic ? body_size(body) : spec.name + ".model = \"rigid\": 6 modes");
}

void BodyComponent::add_body_effects(const ModelBuilder& model, EffectTable& effects) const {
  add_body_effect(*find_body(model.loaded, spec_.name), effects);
}

std::vector<BodySpec> BlockComponent::reduced_bodies() const {
  if (spec_.elastic) return {spec_};
  return {};
}

void BlockComponent::add_body_effects(const ModelBuilder& model, EffectTable& effects) const {
  if (spec_.elastic) {
    BodyComponent::add_body_effects(model, effects);
  } else {
    effects.add("elastic block", false,
                "block.model = \"rigid\": liner and bearings at rest, no body");
  }
}

ComponentList read_bodies(const Config& root) {
  ComponentList bodies;
  for (const Config& table : root.tables("body")) {
    BodySpec spec;
    const std::string name = read_name(table);
    if (root.has("engine") && name == "rod")
      table.fail("name", "found \"rod\", which is the rod of [rod]: expected another name");
    read_body(table, name, spec);
    bodies.push_back(std::make_shared<BodyComponent>(spec));
  }
  return bodies;
}

ComponentList read_block(const Config& root) {
  const auto table = root.find_table("block");
  if (!table) return {};
  BodySpec spec;
  read_body(*table, "block", spec);
  return {std::make_shared<BlockComponent>(spec)};
}

}  // namespace clatter::dynamics
