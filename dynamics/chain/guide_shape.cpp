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

Vector2d point_of(const Config& table, const char* key, size_t index) {
  const std::vector<double> all = table.numbers(key);
  return Vector2d(all[2 * index], all[2 * index + 1]) * kMilli;
}

/// A list x1, y1, x2, y2, ... of points.
std::vector<Vector2d> read_points(const Config& table, const char* key, size_t least, size_t most) {
  const std::vector<double> all = table.numbers(key);
  const size_t count = all.size() / 2;
  if (all.size() % 2 != 0 || count < least || count > most)
    table.fail(key, fmt::format("found {} numbers, expected x, y of {}{} points", all.size(),
                                least == most ? "" : "at least ", least));
  std::vector<Vector2d> points;
  for (size_t i = 0; i < count; ++i) {
    points.push_back(point_of(table, key, i));
    if (!(points.back().lpNorm<Eigen::Infinity>() <= kFarMm * kMilli))
      table.fail(key, fmt::format("found a number beyond {:g}", kFarMm));
  }
  return points;
}

ArcSegment read_arc(const Config& arc) {
  const std::vector<Vector2d> centre = read_points(arc, "centre_mm", 1, 1);
  const Range angle = Range::between(-1e4, 1e4);
  const double from = arc.number("from_deg", angle), to = arc.number("to_deg", angle);
  if (!(std::abs(to - from) <= 360.0) || from == to)
    arc.fail("to_deg", fmt::format("found {:g}, expected within 360 of from_deg = {:g}", to, from));
  return {centre.front(), arc.number("radius_mm", Range::between(1e-3, kFarMm)) * kMilli,
          from * kDegree, (to - from) * kDegree};
}

Segment read_segment(const Config& table) {
  if (const auto arc = table.find_table("arc")) return read_arc(*arc);
  if (table.has("line_mm")) {
    const auto points = read_points(table, "line_mm", 2, 2);
    return LineSegment{points[0], points[1]};
  }
  if (table.has("bezier_mm")) {
    const auto points = read_points(table, "bezier_mm", 4, 4);
    return BezierSegment{{points[0], points[1], points[2], points[3]}};
  }
  if (table.has("points_mm"))
    return PointsSegment{read_points(table, "points_mm", 4, 100000), false, {}, {}};
  throw InputError(table.where() +
                   ": found no shape, expected one of arc, line_mm, bezier_mm, points_mm");
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

void read_guide(const Config& table, double height, ChainOver& over) {
  std::vector<Segment> segments;
  for (const Config& one : table.tables("segment")) segments.push_back(read_segment(one));
  if (segments.empty())
    throw InputError(table.where() + ": found no [[chain.over.segment]], expected the shape of \"" +
                     over.name + "\"");
  ProfileOptions options;
  options.solid = over.turn == Turn::kCounterClockwise ? ProfileOptions::Solid::kLeft
                                                       : ProfileOptions::Solid::kRight;
  options.largest_kink = 0.1;
  over.profile = with_context(table.where("guide"),
                              [&] { return std::make_shared<const Profile>(segments, options); });
  double begin = 0.0;
  for (const Segment& segment : segments) {
    const double length = Profile({segment}, options).length();
    add_circles(segment, *over.profile, begin, begin + length, height, over);
    begin += length;
  }
}

}  // namespace clatter::dynamics
