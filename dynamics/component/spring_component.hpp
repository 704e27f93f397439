// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[spring]]: springs and dampers along the line between two points.
#include <utility>

#include "dynamics/component/component.hpp"
#include "dynamics/component/pair_spec.hpp"

namespace clatter::dynamics {

/// One [[spring]].
struct SpringSpec : PairSpec {
  double length = 0.0;  // without force [m]
};
const Keys<SpringSpec>& spring_keys();

/// All springs of a scene.
class SpringComponent : public Component {
 public:
  explicit SpringComponent(std::vector<SpringSpec> springs) : springs_(std::move(springs)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<SpringComponent>(*this);
  }
  /// InputError for a spring whose ends are at the same point, which has no direction.
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<SpringSpec> springs_;
};

ComponentList read_springs(const Config& root);

}  // namespace clatter::dynamics
