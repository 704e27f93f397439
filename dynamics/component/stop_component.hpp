// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[stop]]: contacts of a point of one body with a plane of another.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/element/stop.hpp"

namespace clatter::dynamics {

/// One [[stop]].
struct StopSpec {
  std::string name, where;  // "stop 1", or with its own name, "stop table"
  PointSpec a, b;           // the point; a point of the plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // at the start, to the side of a
  std::optional<double> restitution;                  // a rigid contact; else a compliant one
  double rest_stiffness = 1e8;       // of a rigid contact, where it comes to rest [N/m]
  double stiffness = 0.0;            // [N/m^exponent]
  double exponent = 1.0, chi = 0.0;  // [1], [s/m]
  FrictionLaw friction;
  std::optional<double> static_friction;  // of it; else its kinetic one
  std::optional<double> stick_stiffness;  // of it; else by the stiffness along the normal [N/m]
};
const Keys<StopSpec>& stop_keys();

/// All stops of a scene.
class StopComponent : public Component {
 public:
  explicit StopComponent(std::vector<StopSpec> stops) : stops_(std::move(stops)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<StopComponent>(*this);
  }
  /// InputError for a contact of two points that no force moves, and for a rigid one whose point is
  /// behind the plane at the start.
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;
  /// Rigid contacts that were held too softly.
  std::vector<std::string> warnings() const override;

 private:
  std::vector<StopSpec> stops_;
  // Of this copy's model.
  std::vector<const RigidStop*> rigid_;
};

ComponentList read_stops(const Config& root);

}  // namespace clatter::dynamics
