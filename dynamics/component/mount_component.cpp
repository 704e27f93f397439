// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/mount_component.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "dynamics/component/block_table.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/element/mount.hpp"

namespace clatter::dynamics {
namespace {

/// Springs to the ground at each node of the sets of a mount.
std::vector<GroundSpring> springs_of(const MountSpec& mount, ModelBuilder& model) {
  std::vector<GroundSpring> springs;
  for (const auto& set : mount.sets) {
    for (int axis = 0; axis < 3; ++axis) {
      if (mount.stiffness[axis] == 0.0 && mount.damping[axis] == 0.0) continue;
      const LoadedBody& body = *find_body(model.loaded, mount.body);
      for (const int dof : with_context(mount.where + ": mount.sets",
                                        [&] { return set_dofs(body.model, set, axis, false); }))
        springs.push_back({model.system.coordinate(model.body(mount.body), dof),
                           mount.stiffness[axis], mount.damping[axis]});
    }
  }
  return springs;
}

}  // namespace

const Keys<MountSpec>& mount_keys() {
  static const Keys<MountSpec> keys(
      "mount", "springs and dampers between nodes of a reduced part and the ground",
      [](auto& key, MountSpec& mount) {
        key.where(mount.where);
        key.text("body", mount.body, "the part");
        key.texts("sets", mount.sets, "sets of its nodes").required();
        key.vector("stiffness_n_m", mount.stiffness, kAnyDamping, "of each node, along x, y, z")
            .required();
        key.vector("damping_n_s_m", mount.damping, kAnyDamping, "of each node, along x, y, z");
        key.check([](const Config& table, MountSpec& found) {
          if (found.stiffness.isZero(0.0) && found.damping.isZero(0.0))
            table.fail("stiffness_n_m",
                       "found 0 everywhere, expected a stiffness or damping above 0");
        });
      });
  return keys;
}

void MountComponent::add_elements(ModelBuilder& model) {
  int count = 0;
  for (const MountSpec& mount : mounts_) {
    if (mount.body == "block" && resting_block_) continue;
    if (find_body(model.loaded, mount.body) == nullptr) {
      throw InputError(
          fmt::format("{}: mount.body: no body \"{}\" in the scene", mount.where, mount.body));
    }
    if (find_body(model.loaded, mount.body)->spec.motion != BodyMotion::kGiven)
      throw InputError(
          fmt::format("{}: mount.body: \"{}\" has large motion, expected one whose frame is at "
                      "rest; [[bushing]] "
                      "holds points of it",
                      mount.where, mount.body));
    auto springs = springs_of(mount, model);
    model.system.add_element(std::make_unique<Mount>(fmt::format("mount {}", ++count), springs));
  }
}

void MountComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  const bool on = elements_.end > elements_.first;
  effects.add(find_effect(kComponentEffects, "mounts"), on,
              on                ? "[[mount]]"
              : mounts_.empty() ? "no [[mount]]"
                                : "no mounted body",
              "mount");
}

ComponentList read_mounts(const Config& root) {
  std::vector<MountSpec> mounts;
  for (const Config& table : root.tables("mount")) mounts.push_back(mount_keys().read(table));
  const bool resting = root.has("block") && !has_elastic_block(root);
  return {std::make_shared<MountComponent>(std::move(mounts), resting)};
}

}  // namespace clatter::dynamics
