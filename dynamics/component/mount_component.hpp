// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[mount]]: springs and dampers between nodes of a body and the ground.
#include <utility>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"

namespace clatter::dynamics {

/// One [[mount]].
struct MountSpec {
  std::string body = "block", where;
  std::vector<std::string> sets;
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();  // x, y, z [N/m]
  Eigen::Vector3d damping = Eigen::Vector3d::Zero();    // x, y, z [N s/m]
};
const keys::Keys<MountSpec>& mount_keys();

/// All mounts of a scene: elements "mount 1", "mount 2", ..., without those of a block that is not
/// simulated.
class MountComponent : public Component {
 public:
  /// `resting_block`: mounts of "block" are left out.
  MountComponent(std::vector<MountSpec> mounts, bool resting_block)
      : mounts_(std::move(mounts)), resting_block_(resting_block) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<MountComponent>(*this);
  }
  /// InputError for a body that is not in the scene.
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<MountSpec> mounts_;
  bool resting_block_;
};

ComponentList read_mounts(const Config& root);

}  // namespace clatter::dynamics
