// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[bushing]]: joints with the elasticity of their bearings.
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/component/law_table.hpp"
#include "dynamics/component/pair_spec.hpp"

namespace clatter::dynamics {

/// One of them.
struct BushingSpec : PairSpec {
  RadialTableSpec table;
  std::optional<RadialTable> law;  // by the table, instead of stiffness and damping
};
const Keys<BushingSpec>& bushing_keys();

/// All bushings of a scene: a spring and damper of the same stiffness in all directions between two
/// points, which is a spherical joint or, between bodies in one plane, a revolute joint; or a table
/// of force over distance.
class BushingComponent : public Component {
 public:
  explicit BushingComponent(std::vector<BushingSpec> bushings) : bushings_(std::move(bushings)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<BushingComponent>(*this);
  }
  std::vector<std::filesystem::path> inputs() const override;
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<BushingSpec> bushings_;
};

ComponentList read_bushings(const Config& root);

}  // namespace clatter::dynamics
