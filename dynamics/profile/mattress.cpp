// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/mattress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/profile/part_contact.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;

PlacedOutline placed(const LinkOutline& outline, const PlanarPose& pose, const PlanarRate& rate) {
  return {
      pose.position, {pose.cosine, pose.sine}, rate.velocity, rate.spin, outline.from, outline.to,
      outline.radius};
}

PlacedOutline in_part(const Vector2d& rotation, const PlacedOutline& link) {
  PlacedOutline result = link;
  result.origin = turned_back(rotation, link.origin);
  result.axis = turned_back(rotation, link.axis);
  result.velocity = turned_back(rotation, link.velocity);
  return result;
}

/// R A R', R the rotation in the plane.
Matrix3d turned_matrix(const Vector2d& rotation, const Matrix3d& matrix) {
  Matrix3d turn = Matrix3d::Identity();
  turn(0, 0) = turn(1, 1) = rotation.x();
  turn(1, 0) = rotation.y();
  turn(0, 1) = -rotation.y();
  return turn * matrix * turn.transpose();
}

void start(bool with_tangent, MattressForce& force) {
  force.wrench.setZero();
  if (with_tangent) {
    force.by_pose.setZero();
    force.by_rate.setZero();
  }
  force.stored = force.lost = force.load = force.slide = 0.0;
  force.depth = 0.0;
  force.too_deep = false;
}

void add(const PartContact& part, const Vector2d& rotation, bool with_tangent,
         MattressForce& force) {
  const SectionSum& sum = part.sum();
  force.wrench.head<2>() += turned(rotation, Vector2d(sum.wrench.head<2>()));
  force.wrench.z() += sum.wrench.z();
  if (with_tangent) {
    force.by_pose += turned_matrix(rotation, sum.by_pose);
    force.by_rate += turned_matrix(rotation, sum.by_rate);
  }
  force.stored += sum.stored;
  force.lost += sum.lost;
  force.load += sum.load;
  force.slide += sum.slide;
  force.depth = std::max(force.depth, sum.depth);
  force.too_deep = force.too_deep || part.inner_side();
}

/// The part of a repeated profile in whose sector the point is, from a first guess.
int part_at(const Profile& profile, const Vector2d& point, int guess) {
  const int count = profile.repeats();
  const Vector2d local = turned_back(profile.rotation(guess), point);
  // Most points are in the sector of the guess.
  const double border = std::numbers::pi / count;
  if (local.x() > 0.0 && std::abs(local.y()) < local.x() * border) return guess;
  const double angle = std::atan2(point.y(), point.x());
  const int part = static_cast<int>(std::lround(angle * count / (2.0 * std::numbers::pi)));
  return ((part % count) + count) % count;
}

/// Parts of a repeated profile to one side of that of a point, which can be within `reach` of it.
struct Neighbours {
  int count = 0;
  double clearance = 0.0;  // from the others, at least [m]
};

/// `local`: the point in the axes of its part, y positive towards that side.
Neighbours neighbours(const Profile& profile, int most, const Vector2d& local, double reach) {
  Neighbours result;
  Vector2d border = profile.border();
  while (result.count < most) {
    // From the border's line, or where that is more than a quarter away, from the axis.
    result.clearance =
        (border.x() > 0.0 ? local.x() * border.y() - local.y() * border.x() : local.x()) - reach;
    if (result.clearance >= 0.0) return result;
    border = turned(profile.rotation(1), border);
    ++result.count;
  }
  result.clearance = std::numeric_limits<double>::infinity();
  return result;
}

/// Adds the forces of the parts from `part` - below to `part` + above. Returns a bound of the
/// distance from them, 0 if they touch.
template <bool kTangent>
double add_parts(const MattressContact& contact, const GaussRule& rule, const PlacedOutline& link,
                 const std::array<int, 3>& parts, MattressForce& force) {
  const Profile& profile = contact.profile();
  const auto [part, below, above] = parts;
  const int count = profile.repeats();
  double clearance = std::numeric_limits<double>::infinity();
  for (int j = -below; j <= above; ++j) {
    const Vector2d& rotation = profile.rotation((part + j + count) % count);
    const PlacedOutline local = in_part(rotation, link);
    PartContact sections(profile, contact.law(), rule, local);
    sections.run<kTangent>();
    if (sections.touches()) {
      add(sections, rotation, kTangent, force);
      clearance = 0.0;
    } else if (clearance > 0.0) {
      clearance = std::min(clearance, least_clearance(profile, local));
    }
  }
  return clearance;
}

/// No point of the outline has moved as far as the clearance at the hint's pose: what is left of
/// it.
double remaining_clearance(const LinkOutline& outline, const PlanarPose& pose,
                           const ContactHint& hint) {
  if (!(hint.clearance > 0.0)) return 0.0;
  const double arm = std::max(std::abs(outline.from), std::abs(outline.to));
  const double turn = (Vector2d(pose.cosine, pose.sine) - hint.axis).squaredNorm();
  const double shift = (pose.position - hint.position).squaredNorm();
  return hint.clearance - std::sqrt(2.0 * (shift + arm * arm * turn));
}

}  // namespace

MattressContact::MattressContact(const Profile& profile, const LinkOutline& outline,
                                 const MattressLaw& law)
    : profile_(&profile),
      outline_(outline),
      law_(law),
      rule_(std::clamp(law.sections, 2, GaussRule::kLargest)) {
  if (!(outline.radius > 0.0) || !(outline.from <= outline.to) || !std::isfinite(outline.radius) ||
      !std::isfinite(outline.to - outline.from))
    throw InputError(
        fmt::format("link outline: radius {:g} m about the line from {:g} to {:g} m, "
                    "expected a radius above 0 and from <= to",
                    outline.radius, outline.from, outline.to));
  const auto check = [](bool right, const char* name, double value, const char* expected) {
    if (!right || !std::isfinite(value))
      throw InputError(fmt::format("mattress: {} {:g}, expected {}", name, value, expected));
  };
  check(law.stiffness > 0.0, "stiffness", law.stiffness, "above 0 N/m3");
  check(law.width > 0.0, "width", law.width, "above 0 m");
  check(law.damping >= 0.0, "damping", law.damping, "0 s/m or more");
  check(law.friction >= 0.0, "friction", law.friction, "0 or more");
  check(law.slip_speed > 0.0, "slip speed", law.slip_speed, "above 0 m/s");
  check(law.sections == rule_.size, "sections", law.sections, "2 to 8");
}

void MattressContact::evaluate(const PlanarPose& pose, const PlanarRate& rate, bool with_tangent,
                               ContactHint& hint, MattressForce& force) const {
  start(with_tangent, force);
  if (const double left = remaining_clearance(outline_, pose, hint); left > 0.0) {
    force.depth = -left;
    return;
  }
  const Profile& profile = *profile_;
  const PlacedOutline link = placed(outline_, pose, rate);
  const Vector2d middle = link.core(0.5 * (link.from + link.to));
  const double reach = 0.5 * (link.to - link.from) + link.radius;
  double clearance = middle.norm() - reach - profile.reach();
  if (!(clearance > 0.0)) {
    Neighbours above, below;
    clearance = std::numeric_limits<double>::infinity();
    const int count = profile.repeats();
    int part = 0;
    if (count > 1) {
      part = hint.part = part_at(profile, middle, hint.part);
      const Vector2d local = turned_back(profile.rotation(part), middle);
      above = neighbours(profile, count / 2, local, reach);
      below = neighbours(profile, (count - 1) / 2, {local.x(), -local.y()}, reach);
      clearance = std::min(above.clearance, below.clearance);
    }
    const std::array<int, 3> parts{part, below.count, above.count};
    const double near = with_tangent ? add_parts<true>(*this, rule_, link, parts, force)
                                     : add_parts<false>(*this, rule_, link, parts, force);
    clearance = std::min(clearance, near);
  }
  hint.position = link.origin;
  hint.axis = link.axis;
  hint.clearance = clearance;
  if (force.depth > 0.5 * link.radius) force.too_deep = true;
  if (force.depth == 0.0) force.depth = -clearance;
}

double small_depth_stiffness(const MattressLaw& law, double radius, double curvature) {
  const double relative = 1.0 / radius + curvature;
  if (!(relative > 0.0))
    throw InputError(
        fmt::format("mattress: circle of radius {:g} m in a hollow of radius {:g} m, "
                    "expected a smaller circle",
                    radius, -1.0 / curvature));
  return 4.0 / 3.0 * law.width * law.stiffness * std::sqrt(2.0 / relative);
}

}  // namespace clatter::dynamics
