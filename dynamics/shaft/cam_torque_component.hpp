// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[cam_torque]]: the torque of valves on their cams, quasi-static.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/component/component.hpp"
#include "dynamics/shaft/torque_component.hpp"

namespace clatter::dynamics {

/// One [[cam_torque]].
struct CamTorqueSpec {
  std::string name;  // "cam_torque 1", or with its own name
  TurnBodies bodies;
  CamTrain train;
  std::filesystem::path file;  // of the lift table; empty: the polynomial law
};

/// All cam torques of a scene, which grow over the ramp of the start.
class CamTorqueComponent : public Component {
 public:
  explicit CamTorqueComponent(std::vector<CamTorqueSpec> torques) : torques_(std::move(torques)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<CamTorqueComponent>(*this);
  }
  std::vector<std::filesystem::path> inputs() const override;
  void add_elements(ModelBuilder& model) override;
  void add_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  std::vector<CamTorqueSpec> torques_;
};

ComponentList read_cam_torques(const Config& root);

/// The cam law of a table: law = "polynomial" with lift_mm and half_angle_deg, or "table" with
/// table, column and spline, whose path goes to `file`.
CamLaw read_cam_law(const Config& table, std::filesystem::path& file);

}  // namespace clatter::dynamics
