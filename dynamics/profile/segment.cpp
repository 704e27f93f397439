// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/segment.hpp"

#include <algorithm>

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

Vector2d flipped(const Vector2d& point) { return {point.x(), -point.y()}; }

struct Mirror {
  Segment operator()(const LineSegment& line) const {
    return LineSegment{flipped(line.to), flipped(line.from)};
  }
  Segment operator()(const ArcSegment& arc) const {
    return ArcSegment{flipped(arc.centre), arc.radius, -(arc.from + arc.turn), arc.turn};
  }
  Segment operator()(const BezierSegment& bezier) const {
    BezierSegment result;
    for (size_t i = 0; i < 4; ++i) result.control[i] = flipped(bezier.control[3 - i]);
    return result;
  }
  Segment operator()(const PointsSegment& spline) const {
    PointsSegment result;
    result.closed = spline.closed;
    for (auto point = spline.points.rbegin(); point != spline.points.rend(); ++point)
      result.points.push_back(flipped(*point));
    if (spline.end_direction) result.start_direction = -flipped(*spline.end_direction);
    if (spline.start_direction) result.end_direction = -flipped(*spline.start_direction);
    return result;
  }
};

}  // namespace

std::vector<Segment> mirrored(const std::vector<Segment>& segments) {
  std::vector<Segment> result;
  for (auto segment = segments.rbegin(); segment != segments.rend(); ++segment)
    result.push_back(std::visit(Mirror{}, *segment));
  return result;
}

}  // namespace clatter::dynamics
