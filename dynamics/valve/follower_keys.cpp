// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/shaft/cam_torque_component.hpp"
#include "dynamics/valve/follower_parts.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

const Range kMillimetres = Range::between(1e-2, 1e4);

/// A key in millimetres with a default in metres.
void read_length(const Config& table, std::string_view key, double& value) {
  value = table.number_or(key, value / kMilli, kMillimetres) * kMilli;
}

void read_place(const Config& table, std::string_view key, Vector2d& value) {
  if (!table.has(key)) return;
  const std::vector<double> two = table.numbers(key, 2);
  for (const double one : two)
    if (!(std::abs(one) <= 1e4))
      table.fail(key, fmt::format("found {:g}, expected at most 10000 in size", one));
  value = Vector2d(two[0], two[1]) * kMilli;
}

}  // namespace

void read_follower(const Config& table, FollowerSpec& spec) {
  FollowerGeometry& at = spec.geometry;
  read_place(table, "roller_mm", at.roller);
  read_length(table, "roller_radius_mm", at.roller_radius);
  read_place(table, "pad_mm", at.pad);
  read_length(table, "pad_radius_mm", at.pad_radius);
  read_place(table, "cam_mm", at.cam);
  if (!(at.base_radius() > 0.0))
    table.fail("cam_mm",
               fmt::format("found the cam's centre {:.4g} mm from the roller's, expected "
                           "more than its radius {:.4g}",
                           (at.roller - at.cam).norm() / kMilli, at.roller_radius / kMilli));
  if (!(at.pad.x() > 0.0))
    table.fail("pad_mm", fmt::format("found {:g} mm beside the ball, expected the pad to the right "
                                     "of it; mirrored turns the plane over",
                                     at.pad.x() / kMilli));
  const Range stiffness = Range::between(1.0, 1e20), chi = Range::between(0.0, 1e3);
  spec.mass = table.number_or("mass_kg", spec.mass, Range::between(1e-9, 1e4));
  read_place(table, "centre_mm", spec.centre);
  spec.inertia = table.number_or("inertia_kg_m2", spec.inertia, Range::between(1e-15, 1e6));
  const double own = spec.inertia - spec.mass * spec.centre.squaredNorm();
  if (!(own > 0.0))
    table.fail("inertia_kg_m2",
               fmt::format("found {:g} about the ball, expected more than {:.4g} of mass_kg at "
                           "centre_mm",
                           spec.inertia, spec.mass * spec.centre.squaredNorm()));
  spec.roller.stiffness =
      table.number_or("roller_stiffness_n_m3", spec.roller.stiffness, stiffness);
  read_length(table, "roller_width_mm", spec.roller.width);
  spec.roller.damping = table.number_or("roller_chi_s_m", spec.roller.damping, chi);
  spec.pad_stiffness = table.number_or("pad_stiffness_n_m", spec.pad_stiffness, stiffness);
  spec.pad_damping = table.number_or("pad_chi_s_m", spec.pad_damping, chi);
  spec.ball_stiffness = table.number_or("ball_stiffness_n_m", spec.ball_stiffness, stiffness);
  spec.ball_damping =
      table.number_or("ball_damping_n_s_m", spec.ball_damping, Range::between(0.0, 1e9));
}

CamSpec read_cam(const Config& table) {
  CamSpec cam;
  if (table.choice("law", {"polynomial", "table", "radius"}) != "radius") {
    cam.law = read_cam_law(table, cam.file);
    return cam;
  }
  cam.file = table.path("table");
  const int degree = table.choice("spline", {"quintic", "cubic"}) == "cubic" ? 3 : 5;
  cam.radius =
      read_angle_table(cam.file, table.text_or("column", ""), "m", 2.0 * std::numbers::pi, degree);
  return cam;
}

LobeSpec read_lobe(const Config& table, size_t number) {
  LobeSpec lobe;
  lobe.name = table.has("name") ? read_name(table) : fmt::format("{}", number);
  lobe.where = table.where();
  lobe.cam.where = table.where();
  lobe.cam.body = table.text("body");
  lobe.cam.at = read_vector(table, "at_mm", 1e6) * kMilli;
  lobe.angle = table.number("deg", Range::between(-1e6, 1e6)) * kDegree;
  return lobe;
}

FollowerPlane read_follower_plane(const Config& table) {
  FollowerPlane plane;
  plane.axis = table.choice("axis", {"z", "x", "y"})[0] - 'x';
  if (table.has("opening") || plane.axis != 2) plane.opening = read_direction(table, "opening");
  if (std::abs(plane.opening(plane.axis)) > 1e-6)
    table.fail("opening", fmt::format("found a direction with {:.4g} along the cam's axis {}, "
                                      "expected one across it",
                                      plane.opening(plane.axis), "xyz"[plane.axis]));
  plane.opening(plane.axis) = 0.0;
  plane.opening.normalize();
  plane.mirrored = table.flag_or("mirrored", false);
  return plane;
}

}  // namespace clatter::dynamics
