// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A finger follower as a body with its contacts.
#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/base/config.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/profile/mattress.hpp"
#include "dynamics/shaft/cam_torque_component.hpp"
#include "dynamics/valve/cam_profile.hpp"
#include "dynamics/valve/follower_geometry.hpp"
#include "dynamics/valve/roller_contact.hpp"

namespace clatter::dynamics {

/// The body of a follower and the laws of its contacts.
struct FollowerSpec {
  FollowerGeometry geometry;
  double mass = 0.040;                     // [kg]
  Eigen::Vector2d centre = {17e-3, 6e-3};  // of mass, in the follower's axes [m]
  double inertia = 2e-5;                   // about the ball [kg m2]
  /// Roller on cam; steel with the elasticity of roller and pin.
  MattressLaw roller{.stiffness = 1e13, .width = 8e-3, .damping = 1.0};
  double pad_stiffness = 5e7, pad_damping = 1.0;      // on the valve's tip [N/m], chi [s/m]
  double ball_stiffness = 5e7, ball_damping = 200.0;  // on its ball [N/m], [N s/m]
};

/// How a cam moves its follower: by a lift law of the valve, or a given profile.
struct CamSpec {
  std::optional<CamLaw> law;  // else the radius
  std::optional<PeriodicSpline> radius;
  std::filesystem::path file;  // of a table; empty: none
  /// InputError at the table's file or as CamProfile says.
  CamProfile profile(const FollowerGeometry& geometry, double turn) const;
};

/// One cam of a shaft: its centre, and the angle of its body at the angle 0 of the law [rad].
struct LobeSpec {
  std::string name, where;
  PointSpec cam;
  double angle = 0.0;
};

/// The plane of followers in the scene.
struct FollowerPlane {
  int axis = 2;                                // of the cam
  Eigen::Vector3d opening = {0.0, -1.0, 0.0};  // direction in which valves open
  bool mirrored = false;                       // the ball is on the other side of the valve
};

/// Where a follower is in the scene.
struct FollowerPlace {
  PlaneAxes plane;    // origin at the ball; second: against the opening direction of the valve
  double turn = 1.0;  // 1: the cam's axis is first x second; -1: opposite
  Eigen::Vector3d direction;  // of the cam's x axis in the axes of its body

  /// @param cam its centre [m]. @param lobe_angle of the cam's body at the law's angle 0 [rad].
  FollowerPlace(const FollowerGeometry& geometry, const Eigen::Vector3d& cam,
                const FollowerPlane& in, double lobe_angle);
  Eigen::Vector3d point(const Eigen::Vector2d& at) const {
    return plane.origin + at.x() * plane.first + at.y() * plane.second;
  }
  /// The cam's angle from the law's zero, in its body's sense, at a rotation of the body.
  double cam_angle(const Eigen::Matrix3d& rotation) const;
};

/// Lift of the valve and its rate at the start.
struct FollowerStart {
  double lift = 0.0, rate = 0.0;  // [m], [m/s]
  double angle = 0.0;             // of the cam from the law's zero [rad]
  FollowerState state;            // at this lift
};
/// As the cam is at the start of the run.
FollowerStart follower_start(ModelBuilder& model, const FollowerSpec& spec,
                             const CamProfile& profile, const FollowerPlace& place,
                             const PointSpec& cam);

/// Adds the body `name` with the coordinates of its centre of mass and its angle in the place's
/// plane. InputError at `where` for an inertia below that of its mass about the ball.
void add_follower_body(ModelBuilder& model, const std::string& name, const std::string& where,
                       const FollowerSpec& spec, const FollowerPlace& place,
                       const FollowerStart& start);

/// Elements of a follower; the model's system owns them.
struct FollowerElements {
  const RollerContact* roller = nullptr;
};
/// What a follower touches: ports of what carries the ball, there, and of the valve, at the centre
/// of the pad while the valve is closed.
struct FollowerNeighbours {
  PointSpec cam;
  std::unique_ptr<Port> ball, tip;
};
/// Adds the contacts of the follower `body`: elements "<name> cam<suffix>", "<name> ball<suffix>",
/// "<name> pad<suffix>".
FollowerElements add_follower_elements(ModelBuilder& model, const std::string& name,
                                       const std::string& suffix, const std::string& body,
                                       const FollowerSpec& spec, const FollowerPlace& place,
                                       const CamProfile& profile, FollowerNeighbours neighbours);

/// Keys of a follower's sizes, masses and contacts.
const Keys<FollowerSpec>& follower_spec_keys();
/// Keys law, and those of the law: "polynomial", "table" of the lift, "radius" of the profile.
template <class S>
void cam_rows(Keys<S>& key, CamLawSpec& law) {
  using Kind = CamLawSpec::Kind;
  key.choice(
      "law", law.kind,
      {{"polynomial", Kind::kPolynomial}, {"table", Kind::kTable}, {"radius", Kind::kRadius}},
      "lift of the valve over the angle of the cam, or a table of the cam's radius over its polar "
      "angle");
  cam_law_rows(key, law, {"table", "radius"});
}
CamSpec make_cam(const CamLawSpec& spec);
/// Keys body, at_mm, deg, and name.
const Keys<LobeSpec>& lobe_keys();
/// Keys axis, opening, mirrored.
const Keys<FollowerPlane>& follower_plane_keys();

}  // namespace clatter::dynamics
