// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A cylinder that is taken out of its engine.
#include <string>
#include <utility>

#include "dynamics/component/component.hpp"
#include "dynamics/cylinder/cylinder_catalogue.hpp"

namespace clatter::dynamics {

/// A [[cylinder]] with `parked = true`: its piston is disconnected. No piston, rod, joint, guide,
/// contact or gas force; what is left is its bore in the block.
class ParkedCylinder : public Component {
 public:
  explicit ParkedCylinder(std::string name) : name_(std::move(name)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<ParkedCylinder>(*this);
  }
  std::string name() const override { return name_; }
  void add_effects(const ModelBuilder&, EffectTable& effects) const override {
    effects.add(find_effect(kCylinderEffects, "piston and rod"), name_ + ": piston and rod", false,
                "cylinder.parked, with its gas and contact");
  }

 private:
  std::string name_;
};

}  // namespace clatter::dynamics
