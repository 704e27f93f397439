// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/segment_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Kind = ProfileCell::Kind;

constexpr double kShortest = 1e-9;  // of a segment [m]
constexpr double kCubicTurn = 0.2;  // of a cell [rad]
constexpr int kCubicCells = 8;      // at least, of a Bezier curve
constexpr double kSlowest = 1e-4;   // speed of a cubic over its mean

double angle_between(const Vector2d& a, const Vector2d& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// Control points of a part of a cubic.
std::array<Vector2d, 4> control_points(const Cubic& cubic, double from, double to) {
  const Vector2d a = cubic.position(from), b = cubic.position(to);
  const double third = (to - from) / 3.0;
  return {a, a + third * cubic.derivative(from), b - third * cubic.derivative(to), b};
}

/// Upper bound of the turn of a cubic: that of its control polygon.
double polygon_turn(const std::array<Vector2d, 4>& b) {
  return angle_between(b[1] - b[0], b[2] - b[1]) + angle_between(b[2] - b[1], b[3] - b[2]);
}

struct CellsOf {
  SegmentCells& to;

  int next_curve() const { return to.cells.empty() ? 0 : to.cells.back().curve + 1; }

  void append(ProfileCell cell) const {
    if (!to.cells.empty()) cell.start = to.cells.back().start + to.cells.back().length;
    to.cells.push_back(cell);
    to.cells.back().length = cell_length(cell, to.cubics, cell.end);
  }

  void operator()(const LineSegment& line) const {
    ProfileCell cell;
    cell.kind = Kind::kLine;
    cell.curve = next_curve();
    cell.origin = line.from;
    cell.end = (line.to - line.from).norm();
    if (!(cell.end > kShortest) || !std::isfinite(cell.end))
      throw InputError(
          fmt::format("a line of {:.3g} m, expected more than {:g} m", cell.end, kShortest));
    cell.first = (line.to - line.from) / cell.end;
    append(cell);
  }

  void operator()(const ArcSegment& arc) const {
    const double turn = std::abs(arc.turn), pi = std::numbers::pi;
    if (!(arc.radius > 0.0) || !arc.centre.allFinite() || !std::isfinite(arc.from) ||
        !std::isfinite(arc.radius))
      throw InputError(
          fmt::format("an arc of radius {:g} m from {:g} rad, expected a radius above 0 "
                      "and finite numbers",
                      arc.radius, arc.from));
    if (!(arc.radius * turn > kShortest) || !(turn <= 2.0 * pi * (1.0 + 1e-12)))
      throw InputError(
          fmt::format("an arc that turns by {:g} rad, expected at most one revolution and a length "
                      "above {:g} m",
                      arc.turn, kShortest));
    const int parts = static_cast<int>(std::ceil(turn / pi - 1e-9));
    const double sign = arc.turn > 0.0 ? 1.0 : -1.0;
    for (int i = 0; i < parts; ++i) {
      const double middle = arc.from + arc.turn * (i + 0.5) / parts;
      ProfileCell cell;
      cell.kind = Kind::kArc;
      cell.curve = next_curve();
      cell.origin = arc.centre;
      cell.radius = arc.radius;
      cell.curvature = sign / arc.radius;
      cell.first = {std::cos(middle), std::sin(middle)};
      cell.second = sign * Vector2d(-cell.first.y(), cell.first.x());
      cell.end = std::tan(0.25 * turn / parts);
      cell.begin = -cell.end;
      append(cell);
    }
  }

  void operator()(const BezierSegment& bezier) const {
    for (const Vector2d& point : bezier.control)
      if (!point.allFinite()) throw InputError("a control point that is not finite");
    add_cubics({bezier_cubic(bezier)}, kCubicCells);
  }

  void operator()(const PointsSegment& spline) const { add_cubics(points_spline(spline), 1); }

  void add_cubics(const std::vector<Cubic>& cubics, int fewest) const {
    const int curve = next_curve();
    for (const Cubic& cubic : cubics) {
      check_speed(cubic);
      to.cubics.push_back(cubic);
      const double turn = polygon_turn(control_points(cubic, cubic.begin, cubic.end));
      const int parts = std::max(fewest, static_cast<int>(std::ceil(turn / kCubicTurn)));
      for (int i = 0; i < parts; ++i) {
        ProfileCell cell;
        cell.kind = Kind::kCubic;
        cell.curve = curve;
        cell.cubic = static_cast<int>(to.cubics.size()) - 1;
        const double step = (cubic.end - cubic.begin) / parts;
        cell.begin = i == 0 ? cubic.begin : to.cells.back().end;
        cell.end = i + 1 == parts ? cubic.end : cubic.begin + step * (i + 1);
        append(cell);
      }
    }
  }

  /// A cubic whose derivative vanishes has no tangent there.
  static void check_speed(const Cubic& cubic) {
    constexpr int kSamples = 256;
    double least = cubic.derivative(cubic.begin).norm(), sum = 0.0;
    for (int i = 0; i <= kSamples; ++i) {
      const double at = cubic.begin + (cubic.end - cubic.begin) * i / kSamples;
      const double speed = cubic.derivative(at).norm();
      least = std::min(least, speed);
      sum += speed;
    }
    const double mean = sum / (kSamples + 1), length = mean * (cubic.end - cubic.begin);
    if (!(length > kShortest))
      throw InputError(
          fmt::format("a curve of {:.3g} m, expected more than {:g} m", length, kShortest));
    if (!(least > kSlowest * mean))
      throw InputError(
          fmt::format("a curve without tangent where its derivative vanishes ({:.3g} of "
                      "its mean), expected control points that are apart",
                      least / mean));
  }
};

}  // namespace

void SegmentCells::add(const Segment& segment) {
  first.push_back(cells.size());
  std::visit(CellsOf{*this}, segment);
}

CurvePoint SegmentCells::begin(size_t segment) const {
  const ProfileCell& cell = cells[first[segment]];
  return cell_point(cell, cubics, cell.begin);
}

CurvePoint SegmentCells::end(size_t segment) const {
  const ProfileCell& cell =
      cells[segment + 1 < first.size() ? first[segment + 1] - 1 : cells.size() - 1];
  return cell_point(cell, cubics, cell.end);
}

Circle bounding_circle(const ProfileCell& cell, const std::vector<Cubic>& cubics) {
  const Vector2d a = cell_point(cell, cubics, cell.begin).position;
  const Vector2d b = cell_point(cell, cubics, cell.end).position;
  const Vector2d middle = 0.5 * (a + b);
  double radius = 0.5 * (b - a).norm();
  // Arcs of at most 180 deg are inside the circle over their chord. A cubic is inside the hull of
  // its control points.
  if (cell.kind == Kind::kCubic) {
    const auto hull = control_points(cubics[cell.cubic], cell.begin, cell.end);
    for (const Vector2d& corner : hull) radius = std::max(radius, (corner - middle).norm());
  }
  return {middle, radius * (1.0 + 1e-12)};
}

}  // namespace clatter::dynamics
