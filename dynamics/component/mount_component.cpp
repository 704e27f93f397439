// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/mount_component.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/force/mount.hpp"

namespace clatter::dynamics {
namespace {

/// Springs to the ground at each node of the sets of a mount.
std::vector<GroundSpring> springs_of(const MountSpec& mount, ModelBuilder& model) {
  std::vector<GroundSpring> springs;
  for (const auto& set : mount.sets) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      if (mount.stiffness[a] == 0.0 && mount.damping[a] == 0.0) continue;
      const LoadedBody& body = *find_body(model.loaded, mount.body);
      for (const int dof : with_context(mount.where + ": mount.sets",
                                        [&] { return set_dofs(body.model, set, axis, false); }))
        springs.push_back({model.system.coordinate(model.body(mount.body), dof), mount.stiffness[a],
                           mount.damping[a]});
    }
  }
  return springs;
}

MountSpec read_mount(const Config& table) {
  MountSpec mount;
  mount.where = table.where();
  mount.body = table.text_or("body", "block");
  mount.sets = table.texts("sets");
  if (mount.sets.empty()) table.fail("sets", "found none, expected names of sets of the body");
  mount.stiffness = table.numbers("stiffness_n_m", 3);
  mount.damping =
      table.has("damping_n_s_m") ? table.numbers("damping_n_s_m", 3) : std::vector<double>(3, 0.0);
  bool acts = false;
  const auto check = [&](const char* key, const std::vector<double>& values) {
    for (const double value : values) {
      if (!(value >= 0.0 && value <= 1e15))
        table.fail(key, fmt::format("found {}, expected at least 0 and at most 1e+15", value));
      acts = acts || value > 0.0;
    }
  };
  check("stiffness_n_m", mount.stiffness);
  check("damping_n_s_m", mount.damping);
  if (!acts)
    table.fail("stiffness_n_m", "found 0 everywhere, expected a stiffness or damping above 0");
  return mount;
}

}  // namespace

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
  for (const Config& table : root.tables("mount")) mounts.push_back(read_mount(table));
  const auto block = root.find_table("block");
  const bool resting = block && block->choice("model", {"elastic", "rigid"}) == "rigid";
  return {std::make_shared<MountComponent>(std::move(mounts), resting)};
}

}  // namespace clatter::dynamics
