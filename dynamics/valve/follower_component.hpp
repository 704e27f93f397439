// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[follower]]: roller finger followers between a cam and a valve.
#include <optional>
#include <string>
#include <utility>

#include "dynamics/component/component.hpp"
#include "dynamics/valve/follower_parts.hpp"

namespace clatter::dynamics {

/// One [[follower]].
struct FollowerTable {
  std::string name, where;
  LobeSpec lobe;
  FollowerPlane plane;
  CamLawSpec law;
  CamSpec cam;  // by the law
  FollowerSpec follower;
  PointSpec ball, tip;  // what carries the ball; the valve
};
const Keys<FollowerTable>& follower_keys();

/// A follower, the body `name` in a plane, with its contacts: cam, ball, tip of a valve that is
/// closed at the start or moves with the cam.
class FollowerComponent : public Component {
 public:
  explicit FollowerComponent(FollowerTable table) : table_(std::move(table)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<FollowerComponent>(*this);
  }
  std::string name() const override { return table_.name; }
  std::vector<std::filesystem::path> inputs() const override;
  ComponentTraits traits() const override { return {.modes = 3}; }
  void add_bodies(ModelBuilder& model) override;
  void add_elements(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;
  /// Where the roller lost the cam.
  std::vector<std::string> warnings() const override;

 private:
  std::string element_name() const { return "follower " + table_.name; }
  FollowerTable table_;
  std::optional<CamProfile> profile_;
  const RollerContact* roller_ = nullptr;  // owned by the model's system
};

/// The row of a cam in the table of effects.
void add_cam_effect(const std::string& name, const std::string& element, const CamProfile& profile,
                    EffectTable& effects);
/// "intake_1: the roller lost its cam 3 times, first at ..."; empty when it did not.
std::string lost_text(const std::string& name, const RollerContact& roller, double turn);
/// "0.0123 s, cam at -35.2 deg".
std::string first_text(const ContactWatch& watch, double turn);

ComponentList read_followers(const Config& root);

}  // namespace clatter::dynamics
