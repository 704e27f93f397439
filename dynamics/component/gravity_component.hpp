// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// gravity_m_s2: the weight of all bodies.
#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"

namespace clatter::dynamics {

struct GravitySpec {
  double acceleration = 0.0;  // [m/s2]; 0: none
};
/// A key of the scene itself.
const keys::Keys<GravitySpec>& gravity_keys();

/// Gravity along -z on every body of the model.
class GravityComponent : public Component {
 public:
  /// @param gravity [m/s2]; 0: none
  explicit GravityComponent(double gravity) : gravity_(gravity) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<GravityComponent>(*this);
  }
  void add_loads(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  double gravity_;
};

ComponentList read_gravity(const Config& root);

}  // namespace clatter::dynamics
