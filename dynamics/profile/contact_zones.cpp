// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/contact_zones.hpp"

#include <array>
#include <cassert>
#include <limits>

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using Kind = ProfileCell::Kind;

/// a y^2 + b y + c.
struct Quadratic {
  double a, b, c;
};

/// {P : |P - centre| = radius} along the curve of a line or an arc.
Quadratic on_circle(const ProfileCell& cell, const Vector2d& centre, double radius) {
  const Vector2d apart = cell.origin - centre;
  const double far = apart.squaredNorm() - radius * radius;
  if (cell.kind == Kind::kLine) return {1.0, 2.0 * apart.dot(cell.first), far};
  const double level = far + cell.radius * cell.radius, twice = 2.0 * cell.radius;
  const double along = twice * apart.dot(cell.first), across = twice * apart.dot(cell.second);
  return {level - along, 2.0 * across, level + along};
}

/// {P : normal . (P - point) = 0} along the curve of a line or an arc.
Quadratic on_line(const ProfileCell& cell, const Vector2d& normal, const Vector2d& point) {
  const double level = normal.dot(cell.origin - point);
  const double along = normal.dot(cell.first);
  if (cell.kind == Kind::kLine) return {0.0, along, level};
  const double first = cell.radius * along, second = cell.radius * normal.dot(cell.second);
  return {level - first, 2.0 * second, level + first};
}

template <class Breaks>
void insert(const ZoneEnd& end, const ProfileCell& cell, Breaks& breaks) {
  // Also refuses what is not a number, of roots that are not there.
  if (!(end.at > cell.begin && end.at < cell.end)) return;
  assert(breaks.size < Breaks::kMost);
  int i = breaks.size++;
  for (; breaks.at[i - 1].at > end.at; --i) breaks.at[i] = breaks.at[i - 1];
  breaks.at[i] = end;
}

/// Inserts the roots; the formula without cancellation (Higham 2002, section 1.8).
template <class Breaks>
void insert_roots(const Quadratic& q, ZoneEnd::Kind kind, const ProfileCell& cell, Breaks& breaks) {
  const double discriminant = q.b * q.b - 4.0 * q.a * q.c;
  if (!(discriminant > 0.0)) return;
  const double sum = -0.5 * (q.b + std::copysign(std::sqrt(discriminant), q.b));
  insert({sum / q.a, kind}, cell, breaks);
  insert({q.c / sum, kind}, cell, breaks);
}

struct Sample {
  double value, slope;
};

/// The root of a function between `from` and `to`, at which its signs differ: Newton's method, by
/// bisection where it leaves the bracket.
template <class Function>
double bracketed_root(const Function& function, double from, double to, bool rising) {
  double at = 0.5 * (from + to);
  const double accuracy = 1e-10 * (to - from);
  for (int i = 0; i < 60 && to - from > accuracy; ++i) {
    const Sample sample = function(at);
    ((sample.value > 0.0) == rising ? to : from) = at;
    const double newton = at - sample.value / sample.slope;
    const double next = newton > from && newton < to ? newton : 0.5 * (from + to);
    const double step = next - at;
    at = next;
    if (std::abs(step) <= accuracy) break;
  }
  return at;
}

/// Along a cubic: the squared distance from the core of the outline less that of its edge, and half
/// of the slope of that.
struct DistanceAlong {
  const Cubic& cubic;
  const PlacedOutline& link;

  Sample operator()(double y) const {
    const Vector2d position = cubic.position(y), apart = position - link.closest(position);
    return {apart.squaredNorm() - link.radius * link.radius, 2.0 * apart.dot(cubic.derivative(y))};
  }
  /// The slope with its own slope, that of the distance from a point that stays.
  Sample slope(double y) const {
    const Vector2d position = cubic.position(y), apart = position - link.closest(position);
    const Vector2d d = cubic.derivative(y);
    return {apart.dot(d), d.squaredNorm() + apart.dot(cubic.second_derivative(y))};
  }
};

/// Coordinate along the link.
struct AlongLink {
  const Cubic& cubic;
  const PlacedOutline& link;
  double x;

  Sample operator()(double y) const {
    return {link.axis.dot(cubic.position(y) - link.origin) - x, link.axis.dot(cubic.derivative(y))};
  }
};

/// Squared distances of a point from the core.
double core_nearest(const Vector2d& point, const PlacedOutline& link) {
  return (link.closest(point) - point).squaredNorm();
}
double core_farthest(const Vector2d& point, const PlacedOutline& link) {
  return std::max((link.core(link.from) - point).squaredNorm(),
                  (link.core(link.to) - point).squaredNorm());
}

/// Distance between the outline and the circle or line of the cell, negative where they meet.
double curve_clearance(const ProfileCell& cell, const PlacedOutline& link) {
  if (cell.kind == Kind::kLine) {
    const Vector2d from = link.core(link.from), to = link.core(link.to);
    const Vector2d normal(-cell.first.y(), cell.first.x());
    const double a = normal.dot(from - cell.origin), b = normal.dot(to - cell.origin);
    return a * b > 0.0 ? std::min(std::abs(a), std::abs(b)) - link.radius : -link.radius;
  }
  const double nearest = std::sqrt(core_nearest(cell.origin, link));
  const double farthest = std::sqrt(core_farthest(cell.origin, link));
  return std::max(nearest - cell.radius, cell.radius - farthest) - link.radius;
}

double circle_clearance(const Circle& circle, const PlacedOutline& link) {
  return (circle.centre - link.closest(circle.centre)).norm() - circle.radius - link.radius;
}

}  // namespace

bool ZoneSearch::reaches(const Circle& circle) const {
  const double apart = circle.radius + link_->radius;
  return (circle.centre - link_->closest(circle.centre)).squaredNorm() < apart * apart;
}

bool ZoneSearch::reaches(const ProfileCell& cell) const {
  if (cell.kind == Kind::kCubic) return true;
  if (cell.kind == Kind::kLine) return curve_clearance(cell, *link_) < 0.0;
  const double outer = cell.radius + link_->radius, inner = cell.radius - link_->radius;
  return core_nearest(cell.origin, *link_) < outer * outer &&
         (inner <= 0.0 || core_farthest(cell.origin, *link_) > inner * inner);
}

ZoneSearch::Breaks ZoneSearch::breaks(const ProfileCell& cell) const {
  Breaks result;
  result.at[0] = {cell.begin, ZoneEnd::Kind::kCurveEnd};
  result.size = 1;
  const Vector2d from = link_->core(link_->from), to = link_->core(link_->to);
  const double radius = link_->radius;
  if (cell.kind == Kind::kCubic) {
    cubic_breaks(cell, result);
  } else {
    constexpr auto kEdge = ZoneEnd::Kind::kEdge, kPartChange = ZoneEnd::Kind::kPartChange;
    insert_roots(on_circle(cell, from, radius), kEdge, cell, result);
    if (link_->from < link_->to) {
      const Vector2d normal = link_->normal();
      insert_roots(on_circle(cell, to, radius), kEdge, cell, result);
      insert_roots(on_line(cell, link_->axis, from), kPartChange, cell, result);
      insert_roots(on_line(cell, link_->axis, to), kPartChange, cell, result);
      insert_roots(on_line(cell, normal, from + radius * normal), kEdge, cell, result);
      insert_roots(on_line(cell, normal, from - radius * normal), kEdge, cell, result);
    }
  }
  result.at[result.size++] = {cell.end, ZoneEnd::Kind::kCurveEnd};
  return result;
}

void ZoneSearch::cubic_breaks(const ProfileCell& cell, Breaks& breaks) const {
  const Cubic& cubic = profile_->cubics()[static_cast<std::size_t>(cell.cubic)];
  const DistanceAlong distance{cubic, *link_};
  const Sample a = distance(cell.begin), b = distance(cell.end);
  const auto insert_root = [&](double from, double to, bool rising) {
    insert({bracketed_root(distance, from, to, rising), ZoneEnd::Kind::kEdge}, cell, breaks);
  };
  if ((a.value < 0.0) != (b.value < 0.0)) {
    insert_root(cell.begin, cell.end, b.value > 0.0);
  } else if ((a.slope < 0.0) != (b.slope < 0.0) && (a.slope < 0.0) == (a.value >= 0.0)) {
    const double extremum = bracketed_root([&](double y) { return distance.slope(y); }, cell.begin,
                                           cell.end, b.slope > 0.0);
    if ((distance(extremum).value < 0.0) != (a.value < 0.0)) {
      insert_root(cell.begin, extremum, a.value < 0.0);
      insert_root(extremum, cell.end, a.value >= 0.0);
    }
  }
  if (!(link_->from < link_->to)) return;
  for (const double x : {link_->from, link_->to}) {
    const AlongLink along{cubic, *link_, x};
    const double first = along(cell.begin).value, last = along(cell.end).value;
    if ((first < 0.0) != (last < 0.0))
      insert({bracketed_root(along, cell.begin, cell.end, last > 0.0), ZoneEnd::Kind::kPartChange},
             cell, breaks);
  }
}

bool ZoneSearch::inside(const ProfileCell& cell, double at, OutlinePart& part) const {
  const Vector2d point = cell_point(cell, profile_->cubics(), at).position;
  const double x = link_->axis.dot(point - link_->origin);
  const bool circle = !(link_->from < link_->to);
  part = circle || x < link_->from ? OutlinePart::kFromEnd
         : x > link_->to           ? OutlinePart::kToEnd
                                   : OutlinePart::kBacks;
  return (point - link_->closest(point)).squaredNorm() < link_->radius * link_->radius;
}

double least_clearance(const Profile& profile, const PlacedOutline& link) {
  const auto& nodes = profile.tree().nodes();
  double least = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(nodes.size());
  for (int i = 0; i < count;) {
    const CircleTree::Node& node = nodes[static_cast<std::size_t>(i)];
    double clearance = circle_clearance(node.circle, link);
    if (clearance >= least) {
      i = node.next;
      continue;
    }
    ++i;
    if (node.cell < 0) continue;
    const ProfileCell& cell = profile.cells()[static_cast<std::size_t>(node.cell)];
    if (cell.kind != Kind::kCubic) clearance = std::max(clearance, curve_clearance(cell, link));
    least = std::min(least, clearance);
  }
  return std::max(least, 0.0);
}

}  // namespace clatter::dynamics
