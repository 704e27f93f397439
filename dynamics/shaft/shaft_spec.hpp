// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a scene says of a shaft.
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/bearing/shaft_axes.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/shaft/disc_body.hpp"
#include "dynamics/shaft/shaft_section.hpp"
#include "dynamics/shaft/torsion_spring.hpp"

namespace clatter::dynamics {

/// One [[shaft.disc]]: a rigid part about its centre, which is on the axis.
struct ShaftDiscSpec {
  std::string name;
  double at = 0.0;  // along the axis [m]
  DiscInertia inertia;
  std::optional<double> diametral;      // of it as given; else half of the polar one [kg m2]
  double unbalance = 0.0, phase = 0.0;  // U [kg m], and its angle on the disc [rad]
  std::optional<TorsionLaw> phaser;     // it turns on the shaft
};

/// One [[shaft.bearing]].
struct ShaftBearingSpec {
  std::string name;
  double at = 0.0;  // along the axis [m]
  PointSpec on;     // of the housing; without body: the ground
  enum class Model : char { kButenschoen, kMoes, kLinear, kCoefficients };
  Model model = Model::kButenschoen;
  std::optional<BearingModel> film;  // else linear
  BearingSize size;
  double stiffness = 0.0, damping = 0.0;  // linear [N/m], [N s/m]
  // Of coefficients: 11, 12, 21, 22 [N/m], [N s/m], or a table of them over the speed.
  std::array<double, 4> stiffnesses{}, dampings{};
  std::filesystem::path table;
  std::optional<BearingCoefficients> coefficients;  // both as they are read
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
  std::vector<ShaftSection> pieces;
  ShaftMaterial material;
  std::optional<ShaftSections> sections;  // of both
  int slices = 0;  // of equal length, for stations between discs and bearings
  std::vector<ShaftDiscSpec> discs;
  std::vector<ShaftBearingSpec> bearings;
  DiscStart start;
  std::string speed_of;  // the [[drive]] whose speed, times the ratio, is that at the start
  double speed_ratio = 1.0;
  double loss_time = 0.0;                                 // damping over stiffness [s]
  double displacement_scale = 0.0, velocity_scale = 0.0;  // of the error test; 0: those of the run
  /// A point of the axis, in the scene's axes [m].
  Eigen::Vector3d point(double at) const { return centre + at * axes.unit(); }
};

/// Rows diameter_mm, width_mm, clearance (relative) and viscosity_mpa_s of a bearing whose key
/// "model" is one of `films`.
template <class S>
void bearing_size_rows(Keys<S>& key, BearingSize& size, const keys::Values& films) {
  const Range millimetres = Range::between(1e-3, 1e5);
  key.number("diameter_mm", size.diameter, millimetres, "diameter of the journal")
      .of("model", films);
  key.number("width_mm", size.width, millimetres, "width of the bearing").of("model", films);
  key.number("clearance", size.clearance, Range::between(1e-6, 0.1),
             "relative: of diameters, over the diameter")
      .of("model", films);
  key.number("viscosity_mpa_s", size.viscosity, Range::between(1e-4, 1e6),
             "dynamic viscosity of the oil")
      .of("model", films);
}
/// InputError for a width over diameter outside of 0.12 to 1, where the impedances hold.
void check_bearing_width(const Config& table, const BearingSize& size);

const Keys<ShaftSpec>& shaft_keys();
/// Reads one [[shaft]] of the scene `root`, whose [[drive]] may give its speed. InputError for
/// sections with gaps, discs and bearings beside the shaft or of the same name.
ShaftSpec read_shaft(const Config& root, const Config& table);

}  // namespace clatter::dynamics
