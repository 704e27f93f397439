// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Profiles of cams.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/given/cam_law.hpp"
#include "dynamics/profile/profile.hpp"
#include "dynamics/valve/follower_geometry.hpp"

namespace clatter::dynamics {

/// The outline of a cam in its own axes, which are those of the follower's plane at angle 0. The
/// cam turns counter-clockwise in the plane by `turn` (1 or -1) times its angle.
class CamProfile {
 public:
  /// The profile that opens the valve by `law`: the envelope of the roller on the pitch curve, at
  /// half degrees, as a spline with continuous curvature. InputError for a law that the follower
  /// cannot reach, and where the envelope would cut itself: there the pitch curve's radius is below
  /// the roller's.
  static CamProfile of_law(const FollowerGeometry& geometry, const CamLaw& law, double turn);
  /// A given profile, as radius [m] over the polar angle in the cam's axes.
  static CamProfile of_radius(const FollowerGeometry& geometry, const PeriodicSpline& radius,
                              double turn);

  const Profile& profile() const { return *profile_; }
  std::shared_ptr<const Profile> shared() const { return profile_; }
  double smallest_radius() const { return smallest_radius_; }  // of curvature, where convex [m]
  bool is_convex() const { return convex_; }
  /// The base circle faces the roller for all angles within `margin` of this one [rad].
  bool rests(double angle, double margin) const;
  /// Lift at which the roller of a follower touches the profile, 0 where it does not [m].
  double lift(const FollowerGeometry& geometry, double angle) const;
  double turn() const { return turn_; }

 private:
  CamProfile(std::vector<Eigen::Vector2d> points, std::vector<char> rests, double turn);
  std::shared_ptr<const Profile> profile_;
  std::vector<char> rests_;  // at equal angles of a turn
  double turn_, smallest_radius_ = 0.0;
  bool convex_ = true;
};

}  // namespace clatter::dynamics
