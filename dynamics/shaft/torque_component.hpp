// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[torque]]: torques over the angle of a body.
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/shaft/turn_torque.hpp"

namespace clatter::dynamics {

/// The bodies of a torque: keys body and reaction.
struct TurnBodies {
  std::string body, where;
  std::string reaction, reaction_where;  // empty: the ground
};
template <class S>
void turn_body_rows(Keys<S>& key, TurnBodies& bodies) {
  key.text("body", bodies.body, "the body on which it acts").required();
  key.text("reaction", bodies.reaction, "the body that bears its reaction; without it the ground");
  key.where(bodies.where, "body");
  key.where(bodies.reaction_where, "reaction");
}

/// The y indices of both angles. InputError for bodies that do not turn, or not about the same
/// axis.
struct TurnAngles {
  int angle = 0;
  std::optional<int> reaction;
};
TurnAngles angles_of(const TurnBodies& bodies, ModelBuilder& model);

/// One [[torque]].
struct TorqueSpec {
  std::string name;  // "torque 1", or with its own name, "torque brake"
  TurnBodies bodies;
  TorqueTable table;
  std::filesystem::path file;  // of the table; empty: none
  std::string column;
  double period = 2.0 * std::numbers::pi;  // of the table [rad]
  int degree = 3;                          // of its spline
};
const Keys<TorqueSpec>& torque_keys();

/// All torques of a scene, which grow over the ramp of the start, but for drag.
class TorqueComponent : public Component {
 public:
  explicit TorqueComponent(std::vector<TorqueSpec> torques) : torques_(std::move(torques)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<TorqueComponent>(*this);
  }
  std::vector<std::filesystem::path> inputs() const override;
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<TorqueSpec> torques_;
};

ComponentList read_torques(const Config& root);

}  // namespace clatter::dynamics
