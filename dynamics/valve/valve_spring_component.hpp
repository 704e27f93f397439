// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[valve_spring]]: coil springs with mass between two points.
#include <optional>
#include <string>
#include <utility>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/valve/coil_spring.hpp"

namespace clatter::dynamics {

/// A coil spring as its keys say.
struct CoilSpringTable {
  CoilSpringSpec spring;
  SpringWire wire;
  std::optional<double> stiffness, mass;  // instead of the wire [N/m], [kg]
};
const keys::Keys<CoilSpringTable>& coil_spring_keys();

/// One [[valve_spring]].
struct ValveSpringSpec {
  std::string name, where;
  PointSpec a, b;  // ends, where they are at the installed length
  CoilSpringTable coil;
};
const keys::Keys<ValveSpringSpec>& valve_spring_keys();

/// A spring with mass; its masses are the body "<name>_coils".
class ValveSpringComponent : public Component {
 public:
  explicit ValveSpringComponent(ValveSpringSpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<ValveSpringComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  ComponentTraits traits() const override { return {.modes = spec_.coil.spring.masses}; }
  /// InputError for a spring whose ends are at the same point.
  void add_bodies(ModelBuilder& model) override;
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::string element_name() const { return "valve_spring " + spec_.name; }
  ValveSpringSpec spec_;
  Eigen::Vector3d from_, to_;  // of the ends [m]
};

/// The row of a spring in the table of effects.
Effect& add_spring_effect(const std::string& element, const CoilSpringSpec& spring,
                          EffectTable& effects);

ComponentList read_valve_springs(const Config& root);

}  // namespace clatter::dynamics
