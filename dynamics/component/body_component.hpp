// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [block] and [[body]]: parts with a reduced model in a frame at rest.
#include <utility>

#include "dynamics/component/component.hpp"

namespace clatter::dynamics {

/// A part with a reduced model, of the name in its spec.
class BodyComponent : public Component {
 public:
  explicit BodyComponent(BodySpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<BodyComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  std::vector<BodySpec> reduced_bodies() const override { return {spec_}; }
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;

 protected:
  BodySpec spec_;
};

/// The engine block, "block"; a rigid one is not simulated.
class BlockComponent : public BodyComponent {
 public:
  using BodyComponent::BodyComponent;
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<BlockComponent>(*this);
  }
  std::vector<BodySpec> reduced_bodies() const override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
};

ComponentList read_bodies(const Config& root);
ComponentList read_block(const Config& root);

/// The row of a body with a reduced model.
void add_body_effect(const LoadedBody& body, EffectTable& effects);

}  // namespace clatter::dynamics
