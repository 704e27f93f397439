// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A taut belt around circles.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace clatter::dynamics {

/// Which way the belt turns around a circle: counter-clockwise, it keeps the centre on its left.
enum class Turn : char { kCounterClockwise = 1, kClockwise = -1 };

/// A circle that the belt passes, in running order.
struct BeltCircle {
  Eigen::Vector2d centre;  // [m]
  double radius = 0.0;     // of the belt's line there [m]
  Turn turn = Turn::kCounterClockwise;
  int owner = 0;           // what it belongs to; a guide may consist of several circles
  double per_angle = 0.0;  // length of belt per angle of wrap; 0: the radius [m/rad]
  bool may_miss = false;   // a guide: the belt may pass without touching it
};

/// A part of a belt: a straight span, or the wrap of one circle.
struct BeltPart {
  bool straight = false;
  int owner = 0;                     // of a wrap; of a span the owner that it leaves
  int next = 0;                      // of a span: the owner that it reaches
  Eigen::Vector2d from, to;          // [m]
  Eigen::Vector2d centre;            // of a wrap [m]
  double angle = 0.0;                // of a wrap: turned, signed [rad]
  double begin = 0.0, length = 0.0;  // along the belt [m]
};

/// A closed belt, its parts in running order from the beginning of the wrap of the first circle.
struct Belt {
  std::vector<BeltPart> parts;
  double length = 0.0;  // [m]

  /// The point at `s` along the belt, which is closed [m].
  Eigen::Vector2d at(double s) const;
  /// Wrap of all circles of an owner [rad]; 0 where the belt misses it.
  double wrap(int owner) const;
  /// Length along the belt of the middle of an owner's wrap [m]; -1 where the belt misses it.
  double middle(int owner) const;
};

/// The shortest belt around the circles in their order, at least one that may not be missed; those
/// that may be missed and would be wrapped backwards are left out. InputError naming the owners, as
/// "a and b" from `names`, whose circles overlap so that no span joins them.
Belt taut_belt(std::vector<BeltCircle> circles, const std::vector<std::string>& names);

}  // namespace clatter::dynamics
