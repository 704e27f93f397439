// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/guide_shape.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;

namespace {

/// Between the points of a curved profile by which the belt passes it [m]: the belt leaves the
/// profile by less than a micrometre at radii of some millimetres.
constexpr double kBetween = 1e-4;
constexpr double kFarMm = 1e6;

/// Refuses lists that are not x, y of so many points.
void check_points(const Config& table, const char* key, const std::vector<double>& list,
                  size_t least, size_t most) {
  const size_t count = list.size() / 2;
  if (table.has(key) && (list.size() % 2 != 0 || count < least || count > most))
    table.fail(key, fmt::format("found {} numbers, expected x, y of {}{} points", list.size(),
                                least == most ? "" : "at least ", least));
}

std::vector<Vector2d> points_of(const std::vector<double>& list) {
  std::vector<Vector2d> points;
  for (size_t k = 0; k + 1 < list.size(); k += 2) points.emplace_back(list[k], list[k + 1]);
  return points;
}

Segment segment_of(const SegmentTable& table) {
  if (table.arc) {
    const ArcTable& arc = *table.arc;
    return ArcSegment{arc.centre, arc.radius, arc.from * kDegree, (arc.to - arc.from) * kDegree};
  }
  if (!table.line.empty()) {
    const auto points = points_of(table.line);
    return LineSegment{points[0], points[1]};
  }
  if (!table.bezier.empty()) {
    const auto points = points_of(table.bezier);
    return BezierSegment{{points[0], points[1], points[2], points[3]}};
  }
  return PointsSegment{points_of(table.points), false, {}, {}};
}

const keys::Keys<ArcTable>& arc_keys() {
  static const keys::Keys<ArcTable> keys("arc", "an arc", [](auto& key, ArcTable& arc) {
    const Range angle = Range::between(-1e4, 1e4), far = Range::between(-kFarMm, kFarMm);
    key.vector("centre_mm", arc.centre, far, "its centre, x and y").required();
    key.number("radius_mm", arc.radius, Range::between(1e-3, kFarMm), "its radius").required();
    key.number("from_deg", arc.from, angle, "where it begins").unconverted().required();
    key.number("to_deg", arc.to, angle, "where it ends").unconverted().required();
    key.check([](const Config& table, ArcTable& found) {
      if (!(std::abs(found.to - found.from) <= 360.0) || found.from == found.to)
        table.fail("to_deg", fmt::format("found {:g}, expected within 360 of from_deg = {:g}",
                                         found.to, found.from));
    });
  });
  return keys;
}

/// Circles along the profile: exact for arcs around which the chain turns as they turn, else small
/// ones about points of the profile.
void add_circles(const Segment& segment, const Profile& profile, double begin, double end,
                 double height, ChainOver& over) {
  const auto add = [&](const Vector2d& centre, double radius) {
    over.belt.push_back({centre, radius, over.turn, 0, 0.0, true});
  };
  if (over.belt.empty()) add(profile.at(begin).position, height);
  if (const auto* arc = std::get_if<ArcSegment>(&segment)) {
    if (arc->turn * static_cast<double>(over.turn) > 0.0) add(arc->centre, arc->radius + height);
  } else if (!std::holds_alternative<LineSegment>(segment)) {
    const int count = static_cast<int>((end - begin) / kBetween);
    for (int i = 1; i < count; ++i)
      add(profile.at(begin + (end - begin) * i / count).position, height);
  }
  add(profile.at(end).position, height);
}

}  // namespace

const keys::Keys<SegmentTable>& segment_keys() {
  static const keys::Keys<SegmentTable> keys(
      "segment",
      "a part of the outline of a guide, in running direction, in the plane's axes at the start",
      [](auto& key, SegmentTable& segment) {
        const Range far = Range::between(-kFarMm, kFarMm);
        key.table("arc", segment.arc, arc_keys());
        key.numbers("line_mm", segment.line, far, "x, y of both ends of a line");
        key.numbers("bezier_mm", segment.bezier, far,
                    "x, y of four points of a cubic Bezier curve");
        key.numbers("points_mm", segment.points, far,
                    "x, y of points on a smooth curve, at least 4");
        key.one_of({"arc", "line_mm", "bezier_mm", "points_mm"});
        key.check([](const Config& table, SegmentTable& found) {
          check_points(table, "line_mm", found.line, 2, 2);
          check_points(table, "bezier_mm", found.bezier, 4, 4);
          check_points(table, "points_mm", found.points, 4, 100000);
        });
      });
  return keys;
}

void make_guide(const std::vector<SegmentTable>& tables, const std::string& where, double height,
                ChainOver& over) {
  std::vector<Segment> segments;
  for (const SegmentTable& one : tables) segments.push_back(segment_of(one));
  ProfileOptions options;
  options.solid = over.turn == Turn::kCounterClockwise ? ProfileOptions::Solid::kLeft
                                                       : ProfileOptions::Solid::kRight;
  options.largest_kink = 0.1;
  over.profile =
      with_context(where, [&] { return std::make_shared<const Profile>(segments, options); });
  double begin = 0.0;
  for (const Segment& segment : segments) {
    const double length = Profile({segment}, options).length();
    add_circles(segment, *over.profile, begin, begin + length, height, over);
    begin += length;
  }
}

}  // namespace clatter::dynamics
