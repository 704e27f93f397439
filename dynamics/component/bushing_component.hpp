// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[bushing]]: joints with the elasticity of their bearings.
#include <utility>

#include "dynamics/component/component.hpp"
#include "dynamics/component/pair_spec.hpp"

namespace clatter::dynamics {

/// All bushings of a scene: a spring and damper of the same stiffness in all directions between two
/// points, which is a spherical joint or, between bodies in one plane, a revolute joint.
class BushingComponent : public Component {
 public:
  explicit BushingComponent(std::vector<PairSpec> pairs) : pairs_(std::move(pairs)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<BushingComponent>(*this);
  }
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<PairSpec> pairs_;
};

ComponentList read_bushings(const Config& root);

}  // namespace clatter::dynamics
