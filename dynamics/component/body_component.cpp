// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/body_component.hpp"

#include <fmt/format.h>

#include <cmath>

#include "dynamics/component/block_table.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/rigid_body_component.hpp"
#include "dynamics/element/moving_frame.hpp"

namespace clatter::dynamics {
namespace {

std::string body_size(const LoadedBody& body) {
  return fmt::format("{} coordinates, {} rigid modes, highest {:.4g} Hz", body.model.size(),
                     body.modal.rigid_modes,
                     std::sqrt(body.modal.omega_squared.maxCoeff()) / 6.283185307179586);
}

void check_body_motion(const Config& table, BodySpec& body) {
  if (!body.drive.empty()) body.motion = BodyMotion::kDrive;
  body.is_placed = body.motion == BodyMotion::kSpace && table.has("centre_mm");
  if (body.motion != BodyMotion::kSpace) return;
  if (!body.elastic)
    table.fail("model",
               "model = \"rigid\" and motion = \"space\" exclude each other: a [[rigid_body]] "
               "moves in space");
  if (body.mode_limit_hz > 0.0)
    table.fail("mode_limit_hz",
               "mode_limit_hz and motion = \"space\" exclude each other: all modes of such a body "
               "keep their inertia, condense fewer");
}

}  // namespace

const Keys<BodySpec>& moving_body_keys() {
  static const Keys<BodySpec> keys(
      "body", "a reduced part whose frame is at rest, moves in space, or turns with a drive",
      [](auto& key, BodySpec& body) {
        name_row(key, body.name).required();
        key.part(body, body_keys());
        key.choice("motion", body.motion,
                   {{"rest", BodyMotion::kGiven}, {"space", BodyMotion::kSpace}},
                   "of its frame: at rest, or free in space");
        key.text("drive", body.drive, "the [[drive]] that turns its frame").needs("motion", "rest");
        key.all_need("motion", "space", "", [&] {
          key.vector("centre_mm", body.start.centre, kPositionMm,
                     "centre of mass at the start; without it that of the model");
          quaternion_row(key, body.start.rotation);
          key.vector("start_velocity_m_s", body.start.velocity, Range::between(-1e4, 1e4),
                     "velocity of the centre of mass at the start");
          key.vector("start_spin_rad_s", body.start.spin, Range::between(-1e6, 1e6),
                     "angular velocity at the start, in the body's axes");
        });
        key.check(check_body_motion);
      });
  return keys;
}

void add_body_effect(const LoadedBody& body, EffectTable& effects) {
  const BodySpec& spec = body.spec;
  effects
      .add(find_effect(kComponentEffects, "elastic body"), "elastic " + spec.name, spec.elastic,
           spec.elastic ? body_size(body) : spec.name + ".model = \"rigid\": 6 modes")
      .unknowns = spec.elastic ? body.modal.modes() : 0;
  const EffectEntry* large = find_effect(kComponentEffects, "large motion of a reduced part");
  if (spec.motion == BodyMotion::kSpace)
    effects.add(large, "large motion of " + spec.name, true,
                "motion = \"space\": eq. (9), mean axes", spec.name + " rotation");
  if (spec.motion == BodyMotion::kDrive)
    effects.add(large, "large motion of " + spec.name, true,
                fmt::format("drive = \"{}\": eq. (9), prescribed", spec.drive),
                spec.name + " frame");
}

ComponentTraits BodyComponent::traits() const {
  constexpr int kRigid = 6;
  return {.modes = spec_.motion == BodyMotion::kSpace ? kSpatial - kRigid : 0};
}

void BodyComponent::add_elements(ModelBuilder& model) {
  if (spec_.motion == BodyMotion::kGiven) return;
  const int index = model.body(spec_.name);
  if (spec_.motion == BodyMotion::kSpace) {
    spatial_ = add_rotation(model.system, index);
    return;
  }
  const Shaft& shaft = *model.shaft_of(spec_);
  const LoadedBody& body = *find_body(model.loaded, spec_.name);
  std::vector<int> y;
  for (int k = 0; k < body.modal.modes(); ++k) y.push_back(model.system.modal_coordinate(index, k));
  model.system.add_element(
      std::make_unique<MovingFrame>(spec_.name, y, body.model.inertia.in(body.modal.shapes),
                                    turning_frame(shaft.drive, shaft.axis, -shaft.centre)));
}

void BodyComponent::record(const System& system, const StageState& state, History& history) const {
  Component::record(system, state, history);
  if (spec_.motion != BodyMotion::kSpace) return;
  record_attitude(spec_.name, spatial_, state, history);
}

void BodyComponent::add_body_effects(const ModelBuilder& model, EffectTable& effects) const {
  add_body_effect(*find_body(model.loaded, spec_.name), effects);
}

std::vector<BodySpec> BlockComponent::reduced_bodies() const {
  if (spec_.elastic) return {spec_};
  return {};
}

void BlockComponent::add_body_effects(const ModelBuilder& model, EffectTable& effects) const {
  if (spec_.elastic) {
    BodyComponent::add_body_effects(model, effects);
  } else {
    effects.add(find_effect(kComponentEffects, "elastic body"), "elastic block", false,
                "block.model = \"rigid\": liner and bearings at rest, no body");
  }
}

ComponentList read_bodies(const Config& root) {
  ComponentList bodies;
  for (const Config& table : root.tables("body")) {
    const BodySpec spec = moving_body_keys().read(table);
    if (root.has("engine") && spec.name == "rod")
      table.fail("name", "found \"rod\", which is the rod of [rod]: expected another name");
    bodies.push_back(std::make_shared<BodyComponent>(spec));
  }
  return bodies;
}

ComponentList read_block(const Config& root) {
  const auto table = root.find_table("block");
  if (!table) return {};
  BodySpec spec = block_keys().read(*table).body;
  spec.name = "block";
  return {std::make_shared<BlockComponent>(spec)};
}

}  // namespace clatter::dynamics
