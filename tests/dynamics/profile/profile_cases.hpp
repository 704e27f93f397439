// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Profiles, outlines and laws of the timing drive, and random poses that touch.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "dynamics/profile/mattress.hpp"
#include "dynamics/profile/tooth_gap.hpp"

namespace clatter::dynamics::testing {

constexpr double kPitch = 8e-3, kBush = 5e-3, kPi = std::numbers::pi;

inline Profile crank_sprocket() { return sprocket(iso606_gap(kPitch, kBush, 20)); }

inline MattressLaw bush_law() { return {5e12, 4.6e-3, 0.5, 0.1, 0.02, 7}; }
inline MattressLaw plate_law() { return {5.357e11, 2.4e-3, 0.5, 0.08, 0.02, 7}; }
inline MattressLaw elastic(MattressLaw law) {
  law.damping = law.friction = 0.0;
  return law;
}

inline LinkOutline bush() { return LinkOutline::circle(-4e-3, 2.5e-3); }
inline LinkOutline plate() { return LinkOutline::plate(-4e-3, 4e-3, 3.6e-3); }

/// The plane y = 0 with the solid below, 40 mm long.
inline Profile flat() { return Profile({LineSegment{{0.02, 0.0}, {-0.02, 0.0}}}); }

/// A convex guide of 280 mm radius on the x axis at its middle, solid below, with round ends.
inline Profile guide() {
  const double radius = 0.28, end = 5e-3, half = 0.1;
  const double out = 0.5 * kPi + half, in = 0.5 * kPi - half;
  const Eigen::Vector2d centre(0.0, -radius);
  const auto towards = [&](double angle) {
    return Eigen::Vector2d(centre +
                           (radius - end) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  };
  return Profile({ArcSegment{towards(in), end, in - 1.2, 1.2},
                  ArcSegment{centre, radius, in, 2.0 * half},
                  ArcSegment{towards(out), end, out, 1.2}});
}

/// Points of an ellipse.
inline PointsSegment ellipse(double a, double b, int count) {
  PointsSegment result;
  result.closed = true;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * i / count;
    result.points.emplace_back(a * std::cos(angle), b * std::sin(angle));
  }
  return result;
}

inline PlanarPose pose_at(const Eigen::Vector3d& q) {
  return {{q.x(), q.y()}, std::cos(q.z()), std::sin(q.z())};
}
inline PlanarRate rate_of(const Eigen::Vector3d& v) { return {{v.x(), v.y()}, v.z()}; }

inline MattressForce force_at(const MattressContact& contact, const Eigen::Vector3d& q,
                              const Eigen::Vector3d& v = Eigen::Vector3d::Zero()) {
  ContactHint hint;
  MattressForce force;
  contact.evaluate(pose_at(q), rate_of(v), true, hint, force);
  return force;
}

/// Random poses at which an outline penetrates a profile by up to `depth`.
class TouchingPoses {
 public:
  TouchingPoses(const MattressContact& contact, double depth, unsigned seed)
      : contact_(&contact), depth_(depth), random_(seed) {}

  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

  /// The angle is random; the outline touches about the arc length `s`.
  Eigen::Vector3d at(double s, double angle) {
    const ProfilePoint point = contact_->profile().at(s);
    const LinkOutline& outline = contact_->outline();
    const Eigen::Vector2d axis(std::cos(angle), std::sin(angle));
    // The end of the core that is deeper in direction of the solid carries the contact.
    const double x = axis.dot(point.normal) > 0.0 ? outline.from : outline.to;
    const Eigen::Vector2d core =
        point.position + (outline.radius - uniform(0.05, 1.0) * depth_) * point.normal;
    const Eigen::Vector2d origin = core - x * axis;
    return {origin.x(), origin.y(), angle};
  }

  Eigen::Vector3d rate(double speed, double spin) {
    return {uniform(-speed, speed), uniform(-speed, speed), uniform(-spin, spin)};
  }

 private:
  const MattressContact* contact_;
  double depth_;
  std::mt19937 random_;
};

}  // namespace clatter::dynamics::testing
