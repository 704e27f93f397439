// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/follower_component.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/valve/valve_catalogue.hpp"

namespace clatter::dynamics {

std::string first_text(const ContactWatch& watch, double turn) {
  const double angle = std::remainder(turn * watch.first_angle(), 2.0 * std::numbers::pi);
  return fmt::format("{:.6g} s, cam at {:.4g} deg", watch.first_time(), angle / kDegree);
}

std::string lost_text(const std::string& name, const RollerContact& roller, double turn) {
  const ContactWatch& lost = roller.losses();
  if (lost.count() == 0) return "";
  return fmt::format(
      "{}: the roller lost its cam {} times, first at {}, {}, by up to {:.4g} um: "
      "the valve floats",
      name, lost.count(), first_text(lost, turn),
      lost.is_open() ? "and is off it at the end"
                     : fmt::format("found it again, last at {:.6g} s", lost.last_time()),
      lost.largest() / kMicro);
}

void add_cam_effect(const std::string& name, const std::string& element, const CamProfile& profile,
                    EffectTable& effects) {
  effects.add(find_effect(kValveEffects, "roller on cam"), name, true,
              fmt::format("roller on a {} profile, smallest radius {:.4g} mm",
                          profile.is_convex() ? "convex" : "partly hollow",
                          profile.smallest_radius() / kMilli),
              element);
}

std::vector<std::filesystem::path> FollowerComponent::inputs() const {
  if (table_.cam.file.empty()) return {};
  return {table_.cam.file};
}

void FollowerComponent::add_bodies(ModelBuilder& model) {
  const FollowerSpec& spec = table_.follower;
  const FollowerPlace place(spec.geometry, *table_.lobe.cam.at, table_.plane, table_.lobe.angle);
  profile_ =
      with_context(table_.where, [&] { return table_.cam.profile(spec.geometry, place.turn); });
  const FollowerStart start = follower_start(model, spec, *profile_, place, table_.lobe.cam);
  add_follower_body(model, table_.name, table_.where, spec, place, start);
}

void FollowerComponent::add_elements(ModelBuilder& model) {
  const FollowerSpec& spec = table_.follower;
  const FollowerPlace place(spec.geometry, *table_.lobe.cam.at, table_.plane, table_.lobe.angle);
  FollowerNeighbours neighbours{table_.lobe.cam,
                                model.port(table_.ball, place.point(Eigen::Vector2d::Zero())),
                                model.port(table_.tip, place.point(spec.geometry.pad))};
  roller_ = add_follower_elements(model, element_name(), "", table_.name, spec, place, *profile_,
                                  std::move(neighbours))
                .roller;
}

void FollowerComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  effects
      .add(find_effect(kValveEffects, "follower"), "follower " + table_.name, true,
           "large motion in a plane, 3 coordinates")
      .unknowns = 3;
}

void FollowerComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  add_cam_effect(element_name() + " contacts", element_name(), *profile_, effects);
}

std::vector<std::string> FollowerComponent::warnings() const {
  const std::string text = lost_text(table_.name, *roller_, table_.plane.mirrored ? -1.0 : 1.0);
  if (text.empty()) return {};
  return {text};
}

ComponentList read_followers(const Config& root) {
  ComponentList followers;
  for (FollowerTable& one : read_named(root, "follower", follower_keys()))
    followers.push_back(std::make_shared<FollowerComponent>(std::move(one)));
  return followers;
}

}  // namespace clatter::dynamics
