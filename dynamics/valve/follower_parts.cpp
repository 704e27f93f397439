// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/follower_parts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/body/rigid_body.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/element/stop.hpp"
#include "dynamics/law/joint_laws.hpp"

namespace clatter::dynamics {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Eigen::Vector3d;

CamProfile CamSpec::profile(const FollowerGeometry& geometry, double turn) const {
  if (law) return CamProfile::of_law(geometry, *law, turn);
  return CamProfile::of_radius(geometry, *radius, turn);
}

FollowerPlace::FollowerPlace(const FollowerGeometry& geometry, const Vector3d& cam,
                             const FollowerPlane& in, double lobe_angle)
    : turn(in.mirrored ? -1.0 : 1.0) {
  const Vector3d normal = Vector3d::Unit(in.axis);
  plane.second = -in.opening;
  plane.first = plane.second.cross(turn * normal);
  plane.origin = cam - geometry.cam.x() * plane.first - geometry.cam.y() * plane.second;
  direction = Eigen::AngleAxisd(-lobe_angle, normal) * plane.first;
}

double FollowerPlace::cam_angle(const Eigen::Matrix3d& rotation) const {
  const Vector3d turned = rotation * direction;
  return turn * std::atan2(turned.dot(plane.second), turned.dot(plane.first));
}

FollowerStart follower_start(ModelBuilder& model, const FollowerSpec& spec,
                             const CamProfile& profile, const FollowerPlace& place,
                             const PointSpec& cam) {
  constexpr double kStep = 1e-3;  // [rad]
  const PortState at = model.at_start(*model.port(cam));
  FollowerStart start;
  start.angle = place.cam_angle(at.rotation);
  start.lift = profile.lift(spec.geometry, start.angle);
  const double speed = place.turn * at.spin.dot(place.plane.first.cross(place.plane.second));
  const double slope = (profile.lift(spec.geometry, start.angle + kStep) -
                        profile.lift(spec.geometry, start.angle - kStep)) /
                       (2.0 * kStep);
  if (start.lift > 0.0) start.rate = slope * speed;
  start.state = follower_at(spec.geometry, {start.lift, slope, 0.0, 0.0}, start.angle, place.turn);
  return start;
}

void add_follower_body(ModelBuilder& model, const std::string& name, const std::string& where,
                       const FollowerSpec& spec, const FollowerPlace& place,
                       const FollowerStart& start) {
  const double own = spec.inertia - spec.mass * spec.centre.squaredNorm();
  if (!(own > 0.0))
    throw InputError(
        fmt::format("{}: inertia_kg_m2: found {:g} about the ball, expected more than "
                    "{:g}, that of the mass at its centre",
                    where, spec.inertia, spec.mass * spec.centre.squaredNorm()));
  PlanarMotion motion;
  motion.angle = -start.state.tilt;
  motion.centre = Rotation2Dd(motion.angle) * spec.centre;
  const double speed = start.state.tilt_by_angle == 0.0 || start.rate == 0.0
                           ? 0.0
                           : -start.rate / (std::cos(start.state.tilt) * spec.geometry.pad.x() +
                                            std::sin(start.state.tilt) * spec.geometry.pad.y());
  motion.spin = speed;
  motion.velocity = speed * Vector2d(-motion.centre.y(), motion.centre.x());
  ModalBody body = make_planar_body(name, spec.mass, own, motion);
  const Vector3d normal = place.plane.first.cross(place.plane.second);
  body.rigid.setZero();
  body.rigid.row(0).head<3>() = std::sqrt(spec.mass) * place.plane.first.transpose();
  body.rigid.row(1).head<3>() = std::sqrt(spec.mass) * place.plane.second.transpose();
  body.rigid.row(2).tail<3>() = std::sqrt(own) * normal.transpose();
  model.add_body(std::move(body), where);
}

FollowerElements add_follower_elements(ModelBuilder& model, const std::string& name,
                                       const std::string& suffix, const std::string& body,
                                       const FollowerSpec& spec, const FollowerPlace& place,
                                       const CamProfile& profile, FollowerNeighbours neighbours) {
  System& system = model.system;
  const int index = model.body(body);
  std::vector<int> y;
  for (int k = 0; k < 3; ++k) y.push_back(system.coordinate(index, k));
  const auto port = [&](const Vector2d& at) {
    return std::make_unique<PlanarPort>(y, at - spec.centre, place.plane);
  };
  auto roller = std::make_unique<RollerContact>(
      name + " cam" + suffix, port(spec.geometry.roller),
      CamCarrier{model.port(neighbours.cam), place.plane, place.direction}, profile.shared(),
      spec.geometry.roller_radius, spec.roller);
  FollowerElements elements{roller.get()};
  system.add_element(std::move(roller));
  system.add_element(std::make_unique<PairElement>(
      name + " ball" + suffix, port(Vector2d::Zero()), std::move(neighbours.ball),
      linear_joint(spec.ball_stiffness, spec.ball_damping)));
  // A disc on a plane is its centre on the plane at its radius.
  const PortState tip = model.at_start(*neighbours.tip);
  PointOnPlane pair(port(spec.geometry.pad), std::move(neighbours.tip),
                    tip.rotation.transpose() * place.plane.second);
  system.add_element(std::make_unique<CompliantStop>(name + " pad" + suffix, std::move(pair),
                                                     spec.pad_stiffness, 1.0, spec.pad_damping,
                                                     FrictionLaw{}));
  return elements;
}

}  // namespace clatter::dynamics
