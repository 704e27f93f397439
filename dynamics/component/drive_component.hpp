// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[drive]]: shafts that turn as prescribed.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/given/drive.hpp"

namespace clatter::dynamics {

/// One [[drive.order]]: of the speed, or of a torque that makes it.
struct DriveOrder {
  double order = 1.0;                       // per turn
  std::optional<double> amplitude, torque;  // [rad/s], [N m]
  std::optional<double> at_speed;           // of the torque, which grows with its square [rad/s]
  double phase = 0.0;                       // [rad]
};

/// One [[drive]].
struct DriveSpec {
  std::string name, where;
  Drive drive{0.0};
  std::filesystem::path table;  // of its speed or angle over time; empty: `drive` is complete
  std::string column;
  bool unwrap = false;              // angles of the table that begin anew go on
  double speed = 0.0, start = 0.0;  // mean [rad/s]; angle at time 0 [rad]
  std::vector<DriveOrder> orders;
  std::optional<double> inertia;                     // for torques of orders [kg m2]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // a point of the axis [m]
  int axis = 0;                                      // it turns about x, y or z, right-handed
  PointSpec bearing;                                 // a node that it follows; without body: none
};
const keys::Keys<DriveSpec>& drive_keys();

/// A shaft without mass on whose points elements may act. What drives it bears their moment about
/// its axis, its bearing or the ground all others.
class DriveComponent : public Component {
 public:
  explicit DriveComponent(DriveSpec spec) : spec_(std::move(spec)) {}
  std::unique_ptr<Component> clone() const override {
    return std::make_unique<DriveComponent>(*this);
  }
  std::string name() const override { return spec_.name; }
  bool repeats(double cycle) const override {
    return spec_.table.empty() && spec_.drive.repeats(cycle);
  }
  std::vector<std::filesystem::path> inputs() const override;
  /// InputError for a table that does not cover the run.
  void add_bodies(ModelBuilder& model) override;
  void add_body_effects(const ModelBuilder& model, EffectTable& effects) const override;

 private:
  DriveSpec spec_;
};

/// Mean speed [rad/s] of the [[drive]] that `key` of `table` names; InputError for another name,
/// and for a drive by a table.
/// The orders of the speed of that drive.
std::vector<SpeedOrder> orders_of_drive(const Config& root, const std::string& name);

double speed_of_drive(const Config& root, const Config& table, const std::string& key,
                      const std::string& name);

ComponentList read_drives(const Config& root);

}  // namespace clatter::dynamics
