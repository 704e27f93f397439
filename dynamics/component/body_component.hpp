// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [block] and [[body]]: parts with a reduced model, in a frame at rest, in space, or on a drive.
#include <utility>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/integrate/spatial_body.hpp"

namespace clatter::dynamics {

/// A part with a reduced model, of the name in its spec. One that moves in space records its centre
/// of mass [m] and its quaternion.
class BodyComponent : public Component {
 public:
  explicit BodyComponent(BodySpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<BodyComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  std::vector<BodySpec> reduced_bodies() const override { return {spec_}; }
  ComponentTraits traits() const override;
  /// Not in space: attitudes are states whose clock goes on.
  bool repeats(double) const override { return spec_.motion != BodyMotion::kSpace; }
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void record(const System& system, const StageState& state, History& history) const override;

 protected:
  BodySpec spec_;

 private:
  SpatialBody spatial_;  // in space
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

/// [[body]].
const keys::Keys<BodySpec>& moving_body_keys();

ComponentList read_bodies(const Config& root);
ComponentList read_block(const Config& root);

/// The row of a body with a reduced model.
void add_body_effect(const LoadedBody& body, EffectTable& effects);

}  // namespace clatter::dynamics
