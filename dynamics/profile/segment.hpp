// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Segments of which planar profiles are made.
#include <Eigen/Core>
#include <array>
#include <optional>
#include <variant>
#include <vector>

namespace clatter::dynamics {

/// A straight line between two points [m].
struct LineSegment {
  Eigen::Vector2d from, to;
};

/// An arc of a circle: from the polar angle `from` about its centre through `turn`,
/// counter-clockwise if positive [rad], at most one revolution. Lengths [m].
struct ArcSegment {
  Eigen::Vector2d centre;
  double radius, from, turn;
};

/// A cubic Bezier curve (Farin 2002) with its four control points [m].
struct BezierSegment {
  std::array<Eigen::Vector2d, 4> control;
};

/// A cubic spline with continuous curvature through points [m], over the length of its chords.
///
/// Closed: periodic, at least 3 points, the first one is not repeated. Open: at least 4 points, or
/// 2 with both directions; an end without a given direction takes the cubic of its neighbour
/// ("not a knot", de Boor 1978).
struct PointsSegment {
  std::vector<Eigen::Vector2d> points;
  bool closed = false;
  std::optional<Eigen::Vector2d> start_direction, end_direction;  // of any length
};

using Segment = std::variant<LineSegment, ArcSegment, BezierSegment, PointsSegment>;

/// The segments mirrored about the x axis and run backwards: the solid stays on its side.
std::vector<Segment> mirrored(const std::vector<Segment>& segments);

}  // namespace clatter::dynamics
