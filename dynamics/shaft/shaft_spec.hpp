// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a scene says of a shaft.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/shaft/disc_body.hpp"
#include "dynamics/shaft/journal_bearing.hpp"
#include "dynamics/shaft/shaft_axes.hpp"
#include "dynamics/shaft/shaft_section.hpp"
#include "dynamics/shaft/torsion_spring.hpp"

namespace clatter::dynamics {

/// One [[shaft.disc]]: a rigid part about its centre, which is on the axis.
struct ShaftDiscSpec {
  std::string name;
  double at = 0.0;  // along the axis [m]
  DiscInertia inertia;
  std::optional<TorsionLaw> phaser;  // it turns on the shaft
};

/// One [[shaft.bearing]].
struct ShaftBearingSpec {
  std::string name;
  double at = 0.0;                   // along the axis [m]
  PointSpec on;                      // of the housing; without body: the ground
  std::optional<BearingModel> film;  // else linear
  BearingSize size;
  double stiffness = 0.0, damping = 0.0;  // linear [N/m], [N s/m]
  ThrustLaw thrust;
};

enum class ShaftModel {
  kFull,     // bending, torsion and stretch; bearings
  kTorsion,  // the discs' angles only: they do not leave the axis
  kRigid,    // one angle
};

/// One [[shaft]].
struct ShaftSpec {
  std::string name, where;
  ShaftAxes axes;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // where `at` is 0 [m]
  ShaftModel model = ShaftModel::kFull;
  std::optional<ShaftSections> sections;
  int slices = 0;  // of equal length, for stations between discs and bearings
  std::vector<ShaftDiscSpec> discs;
  std::vector<ShaftBearingSpec> bearings;
  DiscStart start;
  double loss_time = 0.0;                                 // damping over stiffness [s]
  double displacement_scale = 0.0, velocity_scale = 0.0;  // of the error test; 0: those of the run
  /// A point of the axis, in the scene's axes [m].
  Eigen::Vector3d point(double at) const { return centre + at * axes.unit(); }
};

/// diameter_mm, width_mm, clearance (relative) and viscosity_mpa_s of a bearing. InputError for a
/// width over diameter outside of 0.12 to 1, where the impedances hold.
BearingSize read_bearing_size(const Config& table);

/// Reads one [[shaft]] of the scene `root`, whose [[drive]] may give its speed. InputError for
/// sections with gaps, discs and bearings beside the shaft or of the same name.
ShaftSpec read_shaft(const Config& root, const Config& table);

}  // namespace clatter::dynamics
