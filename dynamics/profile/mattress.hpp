// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contact of a link with a profile by an elastic foundation.
#include <Eigen/Core>

#include "dynamics/profile/gauss_rule.hpp"
#include "dynamics/profile/profile.hpp"

namespace clatter::dynamics {

/// Outline of a part of a link: all points within `radius` of the core, the line from (from, 0) to
/// (to, 0) in the link's axes [m]. A bush is a circle, a plate has straight backs and round ends.
struct LinkOutline {
  double from, to, radius;

  static LinkOutline circle(double at, double radius) { return {at, at, radius}; }
  /// Ends about the pins at x = from and to, backs at `height` on both sides of the pitch line.
  static LinkOutline plate(double from, double to, double height) { return {from, to, height}; }
};

/// The foundation between link and profile.
struct MattressLaw {
  double stiffness;          // kappa = K_E / h of both layers in series [N/m3]
  double width;              // b, across the plane [m]
  double damping = 0.0;      // chi [s/m]
  double friction = 0.0;     // mu
  double slip_speed = 0.02;  // v0, above which friction is mu p [m/s]
  int sections = 7;          // on each smooth part of the contact, 2 to 8; all cost the same
};

/// Position and rotation of the link in the profile's axes.
struct PlanarPose {
  Eigen::Vector2d position;  // of the link's origin [m]
  double cosine, sine;       // of the link's angle
};

/// Motion of the link relative to the profile, in the profile's axes: the derivatives of
/// position and angle of PlanarPose.
struct PlanarRate {
  Eigen::Vector2d velocity;  // [m/s]
  double spin;               // [rad/s]
};

/// Force on the link in the profile's axes; the profile takes the opposite one at the same points.
struct MattressForce {
  Eigen::Vector3d wrench;   // fx, fy [N]; moment about the link's origin [N m]
  Eigen::Matrix3d by_pose;  // d wrench / d(x, y, angle)
  Eigen::Matrix3d by_rate;  // d wrench / d(vx, vy, spin)
  double stored, lost;      // energy of the foundation [J], power of damping and friction [W]
  double load, slide;       // sum of normal forces [N], and of each times its slip [W]
  /// Largest penetration of a section [m]. Without contact: minus a lower bound of the distance.
  double depth;
  /// A section is compressed by more than half of the outline's radius or lies on the inner side of
  /// the profile: the law does not hold, and the caller refuses the state.
  bool too_deep;
};

/// What a contact remembers from one evaluation to the next. It saves time and changes no force.
/// `depth` without contact may depend on it, within its bound.
struct ContactHint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero(), axis = Eigen::Vector2d::Zero();
  double clearance = 0.0;  // at this pose, at least [m]
  int part = 0;            // of a repeated profile: the last one
};

/// Elastic foundation between one outline and one profile, eqs. (4) to (6) of the paper.
///
/// At a point P of the profile the penetration is u = radius - |P - Q|, Q the closest point of the
/// link's core, m = (Q - P)/|Q - P|. The traction on the link, at P, is
///   p (m - mu S(v_t/v0) t),  p = kappa u g(1 + chi u'),  per length of the profile and width,
/// with u' the rate of penetration at P, v_t the slip of the link at P along t (m turned by 90
/// deg),
///   S(x) = x (3 - x^2)/2 up to |x| = 1, then its sign,
///   g(y) = y for y >= 0.1, (y + 0.1)^2/0.4 below, 0 for y <= -0.1: the contact never pulls.
/// Without damping and friction the force is the gradient of kappa b/2 times the integral of u^2.
/// It is integrated by Gauss' rule between the exact ends of the contact, with further ends where
/// the curvature of the profile or of the outline jumps; force, moment and tangent are continuous
/// in pose and rate (but for flat on flat, where the law itself has a kink). The tangent is the
/// exact derivative of the sum, sections that move with the ends of the contact included.
class MattressContact {
 public:
  /// The profile must outlive the contact. InputError for a law or outline outside its range.
  MattressContact(const Profile& profile, const LinkOutline& outline, const MattressLaw& law);

  const Profile& profile() const { return *profile_; }
  const LinkOutline& outline() const { return outline_; }
  const MattressLaw& law() const { return law_; }

  /// Without `with_tangent` by_pose and by_rate are left as they are. Takes no memory.
  void evaluate(const PlanarPose& pose, const PlanarRate& rate, bool with_tangent,
                ContactHint& hint, MattressForce& force) const;

 private:
  const Profile* profile_;
  LinkOutline outline_;
  MattressLaw law_;
  GaussRule rule_;
};

/// C [N/m^1.5] of F = C depth^1.5 between circles in the limit of small depths,
///   C = (4/3) b kappa sqrt(2 R),  1/R = 1/radius + curvature,
/// `curvature` of the profile, positive where the solid is convex [1/m]. InputError where the
/// profile is as hollow as the circle.
double small_depth_stiffness(const MattressLaw& law, double radius, double curvature);

}  // namespace clatter::dynamics
