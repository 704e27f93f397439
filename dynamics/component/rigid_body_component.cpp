// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/rigid_body_component.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"
#include "dynamics/body/rigid_body.hpp"
#include "dynamics/body/spatial_port.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Freedom = RigidBodySpec::Freedom;
using Path = RigidBodySpec::Path;

constexpr double kOffPlane = 1e-6;  // [m]: points of a body in a plane may be so far beside it

/// The axes of a plane by the one normal to it: x of y z, y of z x, z of x y.
struct Axes {
  int first, second;
};

Axes axes_of(int normal) { return {(normal + 1) % 3, (normal + 2) % 3}; }

Vector2d in_plane(const Vector3d& vector, int normal) {
  const Axes axes = axes_of(normal);
  return {vector(axes.first), vector(axes.second)};
}

std::vector<int> all_coordinates(System& system, int body) {
  std::vector<int> y;
  for (int k = 0; k < system.bodies()[body].size(); ++k) y.push_back(system.coordinate(body, k));
  return y;
}

void set_scales(const RigidBodySpec& spec, ModalBody& body) {
  body.displacement_scale = spec.displacement_scale;
  body.velocity_scale = spec.velocity_scale;
}

/// What depends on the motion: how many numbers, and velocities along the axis of a slide.
void check_rigid_motion(const Config& table, RigidBodySpec& body) {
  if (body.path == Path::kSpace) body.motion = Freedom::kSpace;
  if (body.path == Path::kSlide) body.motion = Freedom::kSlide;
  if (body.motion == Freedom::kPlane) body.normal = static_cast<int>(body.path);
  const auto count = [&](const char* key, const std::vector<double>& found) {
    const size_t wanted = body.motion == Freedom::kSpace ? 3 : 1;
    if (!found.empty() && found.size() != wanted)
      table.fail(key, fmt::format("found {} numbers, expected {}", found.size(),
                                  wanted == 1 ? "one about the axis across the plane" : "3"));
  };
  count("inertia_kg_m2", body.moments);
  count("start_spin_rad_s", body.spins);
  std::copy(body.moments.begin(), body.moments.end(), body.inertia.data());
  std::copy(body.spins.begin(), body.spins.end(), body.spin.data());
  if (body.motion == Freedom::kPlane &&
      std::abs(body.velocity(body.normal)) > 1e-6 * body.velocity.norm())
    table.fail(
        "start_velocity_m_s",
        fmt::format("found {:g} m/s across the plane of its motion, expected a velocity in it",
                    body.velocity(body.normal)));
  if (body.motion != Freedom::kSlide) return;
  if (body.guide.body == body.name)
    table.fail("guide", fmt::format("found \"{}\" itself, expected another body", body.name));
  const Vector3d across = body.velocity - body.axis.dot(body.velocity) * body.axis;
  if (across.norm() > 1e-6 * body.velocity.norm())
    table.fail(
        "start_velocity_m_s",
        fmt::format("found {:g} m/s across the axis, expected a velocity along it", across.norm()));
}

}  // namespace

const Keys<RigidBodySpec>& rigid_body_keys() {
  static const Keys<RigidBodySpec> keys(
      "rigid_body", "a rigid body with large motion, in a plane or in space",
      [](auto& key, RigidBodySpec& body) {
        const keys::Values turns{"xy", "yz", "zx", "space"}, plane{"xy", "yz", "zx"};
        key.where(body.where);
        name_row(key, body.name).required();
        key.choice("motion", body.path,
                   {{"xy", Path::kXy},
                    {"yz", Path::kYz},
                    {"zx", Path::kZx},
                    {"space", Path::kSpace},
                    {"slide", Path::kSlide}},
                   "in a plane, in space, or along an axis");
        key.number("mass_kg", body.mass, Range::between(1e-9, 1e9), "mass").required();
        key.one_or_more("inertia_kg_m2", body.moments, Range::between(1e-15, 1e12),
                        "moment of inertia about the centre of mass, in space the three principal "
                        "ones")
            .of("motion", turns);
        key.vector("centre_mm", body.centre, kPositionMm, "centre of mass at the start")
            .needs("motion", turns, "a slide has no position of its own");
        key.number("angle_deg", body.angle, kAngleDeg, "angle at the start").needs("motion", plane);
        quaternion_row(key, body.attitude).needs("motion", "space");
        key.vector("start_velocity_m_s", body.velocity, Range::between(-1e4, 1e4),
                   "velocity at the start");
        key.one_or_more("start_spin_rad_s", body.spins, Range::between(-1e6, 1e6),
                        "angular velocity at the start, in space three numbers in the body's axes")
            .needs("motion", turns);
        key.direction("axis", body.axis, "axis of a slide").of("motion", "slide");
        key.table("guide", body.guide, point_keys(),
                  "point that a slide follows across its axis; without it the ground")
            .needs("motion", "slide");
        error_scale_rows(key, body);
        key.check(check_rigid_motion);
      });
  return keys;
}

ComponentTraits RigidBodyComponent::traits() const {
  const int modes = spec_.motion == Freedom::kSlide   ? 1
                    : spec_.motion == Freedom::kPlane ? 3
                                                      : kSpatial;
  return {.modes = modes};
}

void RigidBodyComponent::add_bodies(ModelBuilder& model) {
  switch (spec_.motion) {
    case Freedom::kPlane:
      return add_planar(model);
    case Freedom::kSpace:
      return add_spatial(model);
    case Freedom::kSlide:
      return add_slide(model);
  }
}

void RigidBodyComponent::add_slide(ModelBuilder& model) {
  ModalBody body = with_context(spec_.where, [&] {
    return make_sliding_body(spec_.name, spec_.mass, spec_.axis, spec_.axis.dot(spec_.velocity));
  });
  if (!spec_.guide.body.empty())
    warn(
        fmt::format("{}: \"{}\" has weight and inertia along its axis alone: across it its guide "
                    "on \"{}\" moves without them (motion = \"space\" with joints has all)",
                    spec_.where, spec_.name, spec_.guide.body));
  set_scales(spec_, body);
  const int index = model.add_body(std::move(body), spec_.where);
  // Bodies that guide each other in a circle would ask for each other's ports without end.
  const auto asked = std::make_shared<bool>(false);
  const auto port = [&model, spec = spec_, index, asked](System& system, const Vector3d& at) {
    if (*asked)
      throw InputError(
          fmt::format("{}: the guides of \"{}\" lead back to it", spec.where, spec.name));
    *asked = true;
    std::unique_ptr<Port> guide = model.port(spec.guide, at);
    *asked = false;
    if (guide->is_driven())
      throw InputError(
          fmt::format("{}: found \"{}\", which is driven, expected a body or the ground",
                      spec.guide.where, spec.guide.body));
    const Vector3d guide_at = model.position(spec.guide, at);
    return std::make_unique<SlidePort>(system.coordinate(index, 0), spec.axis, at, std::move(guide),
                                       guide_at);
  };
  model.add_ports(spec_.name, port, spec_.where);
}

void RigidBodyComponent::add_planar(ModelBuilder& model) {
  const int normal = spec_.normal;
  const Axes axes = axes_of(normal);
  PlanarMotion start;
  start.centre = in_plane(spec_.centre, normal);
  start.angle = spec_.angle;
  start.velocity = in_plane(spec_.velocity, normal);
  start.spin = spec_.spin(0);
  ModalBody body = with_context(spec_.where, [&] {
    return make_planar_body(spec_.name, spec_.mass, spec_.inertia(0), start);
  });
  body.rigid.setZero();
  body.rigid(0, axes.first) = body.rigid(1, axes.second) = std::sqrt(spec_.mass);
  body.rigid(2, 3 + normal) = std::sqrt(spec_.inertia(0));
  set_scales(spec_, body);
  const int index = model.add_body(std::move(body), spec_.where);
  model.add_turn(spec_.name, {index, 2, normal});
  const auto port = [spec = spec_, axes, index](System& system, const Vector3d& at) {
    const Vector3d arm = at - spec.centre;
    if (std::abs(arm(spec.normal)) > kOffPlane)
      throw InputError(
          fmt::format("{}: a joint of \"{}\" is {:.4g} mm beside the plane in which "
                      "it moves, expected on it",
                      spec.where, spec.name, arm(spec.normal) / kMilli));
    const Vector2d turned = Eigen::Rotation2Dd(-spec.angle) * in_plane(arm, spec.normal);
    const Vector3d origin = spec.centre(spec.normal) * Vector3d::Unit(spec.normal);
    const PlaneAxes plane{origin, Vector3d::Unit(axes.first), Vector3d::Unit(axes.second)};
    return std::make_unique<PlanarPort>(all_coordinates(system, index), turned, plane);
  };
  model.add_ports(spec_.name, port, spec_.where);
}

void RigidBodyComponent::add_spatial(ModelBuilder& model) {
  SpatialMotion start;
  start.centre = spec_.centre;
  start.rotation = spec_.attitude;
  start.velocity = spec_.velocity;
  start.spin = spec_.spin;
  ModalBody body = with_context(
      spec_.where, [&] { return make_spatial_body(spec_.name, spec_.mass, spec_.inertia, start); });
  set_scales(spec_, body);
  const int index = model.add_body(std::move(body), spec_.where);
  const auto port = [start, index](System& system, const Vector3d& at) {
    const Vector3d arm = start.rotation.conjugate() * (at - start.centre);
    const auto& frame = system.bodies()[index].frame;
    return std::make_unique<SpatialPort>(all_coordinates(system, index), frame, arm);
  };
  model.add_ports(spec_.name, port, spec_.where);
}

void RigidBodyComponent::add_elements(ModelBuilder& model) {
  static constexpr const char* kAxis[] = {"x", "y", "z"};
  const int body = model.body(spec_.name);
  if (spec_.motion == Freedom::kSpace) {
    spatial_ = add_rotation(model.system, body);
    return;
  }
  const std::vector<int> y = all_coordinates(model.system, body);
  const auto add = [&](size_t k, const char* what, const char* unit) {
    recorded_.push_back({spec_.name + "_" + what, unit, y[k]});
  };
  if (spec_.motion == Freedom::kSlide) return add(0, "travel", "m");
  const Axes axes = axes_of(spec_.normal);
  add(0, kAxis[axes.first], "m");
  add(1, kAxis[axes.second], "m");
  add(2, "angle", "rad");
}

void record_attitude(const std::string& name, const SpatialBody& body, const StageState& state,
                     History& history) {
  static constexpr const char* kAxes[] = {"_x", "_y", "_z"};
  static constexpr const char* kParts[] = {"_qw", "_qx", "_qy", "_qz"};
  for (size_t k = 0; k < 3; ++k) history.put(name + kAxes[k], "m", state.y(body.coordinates[k]));
  const Eigen::Vector4d quaternion = body.quaternion(state);
  for (int k = 0; k < 4; ++k) history.put(name + kParts[k], "1", quaternion(k));
}

void RigidBodyComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  static constexpr const char* kPlanes[] = {"yz", "zx", "xy"};
  const bool is_planar = spec_.motion == Freedom::kPlane, slides = spec_.motion == Freedom::kSlide;
  Effect& row = effects.add(
      find_effect(kComponentEffects, "rigid body"), "rigid " + spec_.name, true,
      slides ? "slides along an axis, 1 coordinate"
      : is_planar
          ? fmt::format("large motion in the plane {}, 3 coordinates", kPlanes[spec_.normal])
          : "large motion in space, 10 coordinates",
      is_planar || slides ? "" : spec_.name + " rotation");
  row.unknowns = traits().modes;
}

void RigidBodyComponent::record(const System&, const StageState& state, History& history) const {
  for (const Recorded& one : recorded_) history.put(one.name, one.unit, state.y(one.coordinate));
  if (spec_.motion == Freedom::kSpace) record_attitude(spec_.name, spatial_, state, history);
}

ComponentList read_rigid_bodies(const Config& root) {
  ComponentList bodies;
  for (const Config& table : root.tables("rigid_body"))
    bodies.push_back(std::make_shared<RigidBodyComponent>(rigid_body_keys().read(table)));
  return bodies;
}

}  // namespace clatter::dynamics
