// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/valve/follower_component.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

void check_follower(const Config& table, FollowerSpec& spec) {
  const FollowerGeometry& at = spec.geometry;
  if (!(at.base_radius() > 0.0))
    table.fail("cam_mm",
               fmt::format("found the cam's centre {:.4g} mm from the roller's, expected "
                           "more than its radius {:.4g}",
                           (at.roller - at.cam).norm() / kMilli, at.roller_radius / kMilli));
  if (!(at.pad.x() > 0.0))
    table.fail("pad_mm", fmt::format("found {:g} mm beside the ball, expected the pad to the right "
                                     "of it; mirrored turns the plane over",
                                     at.pad.x() / kMilli));
  const double of_mass = spec.mass * spec.centre.squaredNorm();
  if (!(spec.inertia > of_mass))
    table.fail("inertia_kg_m2",
               fmt::format("found {:g} about the ball, expected more than {:.4g} of mass_kg at "
                           "centre_mm",
                           spec.inertia, of_mass));
}

}  // namespace

const Keys<FollowerSpec>& follower_spec_keys() {
  static const Keys<FollowerSpec> keys(
      "follower", "sizes, mass and contacts of a finger follower",
      [](auto& key, FollowerSpec& spec) {
        const Range millimetres = Range::between(1e-2, 1e4), place = Range::between(-1e4, 1e4);
        const Range stiffness = Range::between(1.0, 1e20), chi = Range::between(0.0, 1e3);
        FollowerGeometry& at = spec.geometry;
        key.vector("roller_mm", at.roller, place,
                   "centre of the roller, from the ball along and up the follower");
        key.number("roller_radius_mm", at.roller_radius, millimetres, "radius of the roller");
        key.vector("pad_mm", at.pad, place, "centre of the pad on the valve, from the ball");
        key.number("pad_radius_mm", at.pad_radius, millimetres, "radius of the pad");
        key.vector("cam_mm", at.cam, place, "centre of the cam, from the ball");
        key.number("mass_kg", spec.mass, Range::between(1e-9, 1e4), "mass");
        key.vector("centre_mm", spec.centre, place, "centre of mass, from the ball");
        key.number("inertia_kg_m2", spec.inertia, Range::between(1e-15, 1e6),
                   "moment of inertia about the ball");
        key.number("roller_stiffness_n_m3", spec.roller.stiffness, stiffness,
                   "of the elastic foundation between roller and cam");
        key.number("roller_width_mm", spec.roller.width, millimetres, "width of the roller");
        key.number("roller_chi_s_m", spec.roller.damping, chi,
                   "damping of roller on cam: the pressure is times 1 + chi rate");
        key.number("pad_stiffness_n_m", spec.pad_stiffness, stiffness, "of the pad on the valve");
        key.number("pad_chi_s_m", spec.pad_damping, chi,
                   "damping of the pad: the force is times 1 + chi rate");
        key.number("ball_stiffness_n_m", spec.ball_stiffness, stiffness, "of the ball joint");
        key.number("ball_damping_n_s_m", spec.ball_damping, Range::between(0.0, 1e9),
                   "of the ball joint");
        key.check(check_follower);
      });
  return keys;
}

CamSpec make_cam(const CamLawSpec& spec) {
  CamSpec cam;
  cam.file = spec.file;
  if (spec.kind != CamLawSpec::Kind::kRadius)
    cam.law = make_cam_law(spec);
  else
    cam.radius = read_angle_table(spec.file, spec.column, "m", 2.0 * std::numbers::pi, spec.degree);
  return cam;
}

const Keys<LobeSpec>& lobe_keys() {
  static const Keys<LobeSpec> keys("cam", "one cam of a shaft", [](auto& key, LobeSpec& lobe) {
    key.where(lobe.where);
    key.where(lobe.cam.where);
    name_row(key, lobe.name);
    key.text("body", lobe.cam.body, "the body that carries it").required();
    key.vector("at_mm", lobe.cam.at, kPositionMm, "its centre, in the scene's axes").required();
    key.number("deg", lobe.angle, kAngleDeg, "angle of its body at the law's angle 0")
        .times(kDegree)
        .shown_in("deg")
        .required();
  });
  return keys;
}

const Keys<FollowerPlane>& follower_plane_keys() {
  static const Keys<FollowerPlane> keys(
      "plane", "the plane of a follower", [](auto& key, FollowerPlane& plane) {
        axis_row(key, plane.axis);
        key.direction("opening", plane.opening, "direction in which valves open; -y without it")
            .required_with("axis", {"x", "y"});
        key.flag("mirrored", plane.mirrored, "the ball is on the other side of the valve");
        key.check([](const Config& table, FollowerPlane& found) {
          const double along = found.opening(found.axis);
          if (std::abs(along) > 1e-6)
            table.fail("opening",
                       fmt::format("found a direction with {:.4g} along the cam's axis {}, "
                                   "expected one across it",
                                   along, "xyz"[found.axis]));
          found.opening(found.axis) = 0.0;
          found.opening.normalize();
        });
      });
  return keys;
}

const Keys<FollowerTable>& follower_keys() {
  static const Keys<FollowerTable> keys(
      "follower", "a roller finger follower between a cam and a valve",
      [](auto& key, FollowerTable& follower) {
        key.where(follower.where);
        name_row(key, follower.name).required();
        key.table("cam", follower.lobe, lobe_keys()).required();
        key.part(follower.plane, follower_plane_keys());
        cam_rows(key, follower.law);
        key.part(follower.follower, follower_spec_keys());
        key.table("ball", follower.ball, point_keys(),
                  "what carries the ball; without it the ground");
        key.table("tip", follower.tip, point_keys(), "the valve").required();
        key.check([](const Config&, FollowerTable& found) { found.cam = make_cam(found.law); });
      });
  return keys;
}

}  // namespace clatter::dynamics
