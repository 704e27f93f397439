// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[drive]]: shafts that turn as prescribed.
#include <Eigen/Core>
#include <string_view>
#include <utility>

#include "dynamics/component/component.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/given/drive.hpp"

namespace clatter::dynamics {

/// One [[drive]].
struct DriveSpec {
  std::string name, where;
  Drive drive{0.0};
  std::filesystem::path table;  // of its speed or angle over time; empty: `drive` is complete
  std::string column;
  double start = 0.0;                                // added to the angle of the table [rad]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // a point of the axis [m]
  int axis = 0;                                      // it turns about x, y or z, right-handed
  PointSpec bearing;                                 // a node that it follows; without body: none
};

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
double speed_of_drive(const Config& root, const Config& table, std::string_view key);

ComponentList read_drives(const Config& root);

}  // namespace clatter::dynamics
