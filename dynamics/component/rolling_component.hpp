// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[rolling_disc]]: discs that roll and slide on planes.
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/element/disc_contact.hpp"

namespace clatter::dynamics {

/// One [[rolling_disc]].
struct RollingDiscSpec {
  std::string name, where;  // "rolling_disc 1", or with its own name
  std::string body;         // a rigid body in space; its centre of mass is that of the disc
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // at the start, unit vector
  double radius = 0.0;                              // [m]
  double chi = 0.0;                                 // damping by the rate of the depth [s/m]
  DiscPlane plane;
};
const Keys<RollingDiscSpec>& rolling_disc_keys();

/// All rolling discs of a scene.
class RollingComponent : public Component {
 public:
  explicit RollingComponent(std::vector<RollingDiscSpec> discs) : discs_(std::move(discs)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<RollingComponent>(*this);
  }
  /// InputError for a body that is no rigid one in space, and for a disc that lies flat.
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<RollingDiscSpec> discs_;
};

ComponentList read_rolling_discs(const Config& root);

}  // namespace clatter::dynamics
