// SPDX-License-Identifier: GPL-3.0-or-later
// Closest points of profiles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/profile/profile.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Kind = ProfileCell::Kind;

/// Where the distance to the point, whose derivative is negative at `from` and positive at `to`, is
/// smallest: Newton's method, by bisection where it leaves the bracket.
double cubic_minimum(const Cubic& cubic, const Vector2d& point, double from, double to) {
  double at = 0.5 * (from + to);
  const double accuracy = 1e-15 * (std::abs(from) + std::abs(to));
  for (int i = 0; i < 80 && to - from > accuracy; ++i) {
    const Vector2d apart = cubic.position(at) - point, d = cubic.derivative(at);
    const double slope = apart.dot(d);
    (slope > 0.0 ? to : from) = at;
    const double next = at - slope / (d.squaredNorm() + apart.dot(cubic.second_derivative(at)));
    const double step = next > from && next < to ? next - at : 0.5 * (from + to) - at;
    at += step;
    if (std::abs(step) <= accuracy) break;
  }
  return at;
}

double closest_parameter(const ProfileCell& cell, const std::vector<Cubic>& cubics,
                         const Vector2d& point, double from, double to) {
  const Vector2d apart = point - cell.origin;
  if (cell.kind == Kind::kLine) return std::clamp(apart.dot(cell.first), from, to);
  const auto distance = [&](double y) {
    return (cell_point(cell, cubics, y).position - point).norm();
  };
  const double end = distance(from) <= distance(to) ? from : to;
  if (cell.kind == Kind::kArc) {
    const double along = apart.dot(cell.first), across = apart.dot(cell.second);
    const double y = across / (along + std::hypot(along, across));
    return y > from && y < to ? y : end;
  }
  const Cubic& cubic = cubics[cell.cubic];
  const auto slope = [&](double y) { return (cubic.position(y) - point).dot(cubic.derivative(y)); };
  if (!(slope(from) < 0.0 && slope(to) > 0.0)) return end;
  const double inner = cubic_minimum(cubic, point, from, to);
  return distance(inner) <= distance(end) ? inner : end;
}

}  // namespace

struct Profile::Found {
  double distance = std::numeric_limits<double>::infinity();
  int part = 0;
  size_t cell = 0;
  double parameter = 0.0;
};

void Profile::search(const Vector2d& point, int part, size_t index, double from, double to,
                     Found& best) const {
  const Vector2d local = turned_back(rotation(part), point);
  const ProfileCell& cell = cells_[index];
  const double y = closest_parameter(cell, cubics_, local, from, to);
  const double distance = (cell_point(cell, cubics_, y).position - local).norm();
  if (distance < best.distance) best = {distance, part, index, y};
}

ClosestPoint Profile::result(const Vector2d& point, const Found& found) const {
  const ProfileCell& cell = cells_[found.cell];
  ClosestPoint closest;
  closest.point = describe(cell, found.parameter, found.part);
  closest.arc_length =
      found.part * part_length_ + cell.start + cell_length(cell, cubics_, found.parameter);
  if (closed() && closest.arc_length >= length()) closest.arc_length -= length();
  const bool outside = (point - closest.point.position).dot(closest.point.normal) >= 0.0;
  closest.distance = outside ? found.distance : -found.distance;
  return closest;
}

ClosestPoint Profile::closest(const Vector2d& point) const {
  Found best;
  for (int part = 0; part < repeats_; ++part)
    for (size_t i = 0; i < cells_.size(); ++i)
      search(point, part, i, cells_[i].begin, cells_[i].end, best);
  return result(point, best);
}

ClosestPoint Profile::closest(const Vector2d& point, double hint, double window) const {
  double from = hint - window, to = hint + window;
  if (closed()) {
    if (to - from >= length()) return closest(point);
    const double turns = std::floor(from / length()) * length();
    from -= turns;
    to -= turns;
  } else {
    from = std::clamp(from, 0.0, part_length_);
    to = std::clamp(to, 0.0, part_length_);
  }
  Found best;
  int part = closed() ? static_cast<int>(from / part_length_) : 0;
  size_t i = cell_at(from - part * part_length_);
  while (true) {
    const ProfileCell& cell = cells_[i];
    const double before = part * part_length_ + cell.start;  // arc length, through the seam
    const double a = cell_parameter(cell, cubics_, std::clamp(from - before, 0.0, cell.length));
    const double b = cell_parameter(cell, cubics_, std::clamp(to - before, 0.0, cell.length));
    search(point, part % repeats_, i, a, b, best);
    if (before + cell.length >= to) break;
    if (++i == cells_.size()) {
      if (!closed()) break;
      i = 0;
      ++part;
    }
  }
  return result(point, best);
}

}  // namespace clatter::dynamics
