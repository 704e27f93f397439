// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Planar profiles of solids: sprockets, guides, arms.
#include <Eigen/Core>
#include <vector>

#include "dynamics/profile/circle_tree.hpp"
#include "dynamics/profile/profile_cell.hpp"
#include "dynamics/profile/segment.hpp"

namespace clatter::dynamics {

/// What a profile is besides its segments.
struct ProfileOptions {
  enum class Solid { kLeft, kRight };  // seen along the running direction

  Solid solid = Solid::kLeft;
  bool closed = false;         // the last segment ends where the first one begins
  int repeats = 1;             // the segments are one of so many equal parts of a revolution
  double largest_kink = 1e-3;  // between the tangents of neighbouring segments [rad]
};

/// A point of a profile, in the profile's axes.
struct ProfilePoint {
  Eigen::Vector2d position;  // [m]
  Eigen::Vector2d tangent;   // unit vector along the running direction
  Eigen::Vector2d normal;    // unit vector out of the solid
  double curvature;          // positive where the solid is convex [1/m]
};

/// The point of a profile closest to a given one.
struct ClosestPoint {
  double arc_length;  // [m]
  double distance;    // positive outside the solid [m]
  ProfilePoint point;
};

/// A curve of lines, arcs, Bezier curves and splines with the solid on one side.
///
/// With `repeats` = z the segments are one tooth gap (or any part) of a sprocket, which is repeated
/// by rotations of 2 pi/z about the origin; they run counter-clockwise and each part begins where
/// the one before ends. Points on the border of two segments belong to the later one.
class Profile {
 public:
  /// InputError for a segment that has no length or no tangent, for ends more than 1e-9 m apart,
  /// and for kinks.
  explicit Profile(const std::vector<Segment>& segments, const ProfileOptions& options = {});

  double length() const { return repeats_ * part_length_; }  // of all parts [m]
  double part_length() const { return part_length_; }        // of one of the repeated parts [m]
  bool closed() const { return closed_ || repeats_ > 1; }
  int repeats() const { return repeats_; }
  /// No point of the profile is farther from the origin [m].
  double reach() const { return reach_; }

  /// The point at an arc length, which is taken modulo the length of a closed profile and limited
  /// to the ends of an open one.
  ProfilePoint at(double arc_length) const;

  /// Closest of all points. Looks at every cell.
  ClosestPoint closest(const Eigen::Vector2d& point) const;
  /// Closest of the points with arc lengths within `window` of `hint` [m]; looks only at the cells
  /// there. The arc length found is in [0, length) on a closed profile.
  ClosestPoint closest(const Eigen::Vector2d& point, double hint, double window) const;

  // What contacts need, for the first of the repeated parts.
  const std::vector<ProfileCell>& cells() const { return cells_; }
  const std::vector<Cubic>& cubics() const { return cubics_; }
  const CircleTree& tree() const { return tree_; }
  /// cos and sin of the angle by which part `index`, 0 to repeats - 1, is turned.
  const Eigen::Vector2d& rotation(int index) const { return rotations_[index]; }
  /// cos and sin of half of the angle of a part.
  const Eigen::Vector2d& border() const { return border_; }
  /// Out of the solid, of the length of the derivative by the parameter.
  Eigen::Vector2d outward(const Eigen::Vector2d& derivative) const {
    return side_ * Eigen::Vector2d(derivative.y(), -derivative.x());
  }

 private:
  struct Found;

  ProfilePoint describe(const ProfileCell& cell, double parameter, int part) const;
  void search(const Eigen::Vector2d& point, int part, size_t cell, double from, double to,
              Found& best) const;
  ClosestPoint result(const Eigen::Vector2d& point, const Found& found) const;
  size_t cell_at(double arc_length) const;

  double side_;  // 1: the solid is on the left, -1: on the right
  bool closed_;
  int repeats_;
  double part_length_ = 0.0, reach_ = 0.0;
  std::vector<Cubic> cubics_;
  std::vector<ProfileCell> cells_;
  CircleTree tree_;
  std::vector<Eigen::Vector2d> rotations_;
  Eigen::Vector2d border_;
};

/// The vector turned by the angle with this cosine and sine.
inline Eigen::Vector2d turned(const Eigen::Vector2d& rotation, const Eigen::Vector2d& vector) {
  return {rotation.x() * vector.x() - rotation.y() * vector.y(),
          rotation.y() * vector.x() + rotation.x() * vector.y()};
}

/// The vector turned back.
inline Eigen::Vector2d turned_back(const Eigen::Vector2d& rotation, const Eigen::Vector2d& vector) {
  return {rotation.x() * vector.x() + rotation.y() * vector.y(),
          rotation.x() * vector.y() - rotation.y() * vector.x()};
}

}  // namespace clatter::dynamics
