// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/belt.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/chain/plane_vector.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double signed_radius(const BeltCircle& circle) {
  return static_cast<double>(circle.turn) * circle.radius;
}

/// The direction of the span from circle a to circle b. The centre of a circle lies its signed
/// radius to the left of the line, so D = b - a = (l + i e) u as complex numbers, e = r_b - r_a.
Vector2d span_direction(const BeltCircle& a, const BeltCircle& b,
                        const std::vector<std::string>& names) {
  const Vector2d D = b.centre - a.centre;
  const double e = signed_radius(b) - signed_radius(a), squared = D.squaredNorm() - e * e;
  // Caps touch the arc that they end from within, to rounding.
  if (!(squared > -1e-9 * D.squaredNorm()) || D.squaredNorm() == 0.0)
    throw InputError(fmt::format(
        "no straight span joins {} and {}: their circles are {:.4g} mm apart, expected more than "
        "{:.4g} mm",
        names[a.owner], names[b.owner], D.norm() * 1e3, std::abs(e) * 1e3));
  const double l = std::sqrt(std::max(0.0, squared));
  return ((l * D - e * across(D)) / D.squaredNorm()).normalized();
}

/// Angle from one direction to another in the circle's own sense of turning.
double wrap_angle(const BeltCircle& circle, const Vector2d& in, const Vector2d& out) {
  const double angle = static_cast<double>(circle.turn) *
                       std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  return circle.may_miss || angle >= 0.0 ? angle : angle + kTurn;
}

struct Spans {
  std::vector<Vector2d> direction;  // of the span that leaves each circle
  std::vector<double> wrap;         // of each circle
};

Spans spans_of(const std::vector<BeltCircle>& circles, const std::vector<std::string>& names) {
  const size_t n = circles.size();
  Spans spans;
  for (size_t i = 0; i < n; ++i)
    spans.direction.push_back(span_direction(circles[i], circles[(i + 1) % n], names));
  for (size_t i = 0; i < n; ++i)
    spans.wrap.push_back(
        wrap_angle(circles[i], spans.direction[(i + n - 1) % n], spans.direction[i]));
  return spans;
}

/// The circle that is wrapped backwards the most; n: none.
size_t worst_missed(const std::vector<BeltCircle>& circles, const Spans& spans) {
  size_t worst = circles.size();
  for (size_t i = 0; i < circles.size(); ++i)
    if (circles[i].may_miss && spans.wrap[i] < 0.0 &&
        (worst == circles.size() || spans.wrap[i] < spans.wrap[worst]))
      worst = i;
  return worst;
}

}  // namespace

Belt taut_belt(std::vector<BeltCircle> circles, const std::vector<std::string>& names) {
  Spans spans = spans_of(circles, names);
  for (;;) {
    const size_t missed = worst_missed(circles, spans);
    if (missed == circles.size()) break;
    circles.erase(circles.begin() + static_cast<std::ptrdiff_t>(missed));
    spans = spans_of(circles, names);
  }
  Belt belt;
  const size_t n = circles.size();
  const auto touch = [&](size_t i, const Vector2d& direction) -> Vector2d {
    return circles[i].centre - signed_radius(circles[i]) * across(direction);
  };
  const auto add = [&](BeltPart part) {
    part.begin = belt.length;
    belt.length += part.length;
    belt.parts.push_back(part);
  };
  for (size_t i = 0; i < n; ++i) {
    const BeltCircle& circle = circles[i];
    const size_t k = (i + 1) % n;
    BeltPart wrap;
    wrap.owner = circle.owner;
    wrap.from = touch(i, spans.direction[(i + n - 1) % n]);
    wrap.to = touch(i, spans.direction[i]);
    wrap.centre = circle.centre;
    wrap.angle = static_cast<double>(circle.turn) * spans.wrap[i];
    wrap.length = spans.wrap[i] * (circle.per_angle > 0.0 ? circle.per_angle : circle.radius);
    add(wrap);
    BeltPart span;
    span.straight = true;
    span.owner = circle.owner;
    span.next = circles[k].owner;
    span.from = wrap.to;
    span.to = touch(k, spans.direction[i]);
    span.length = (span.to - span.from).norm();
    add(span);
  }
  return belt;
}

Vector2d Belt::at(double s) const {
  s -= length * std::floor(s / length);
  for (const BeltPart& part : parts) {
    if (s > part.begin + part.length && &part != &parts.back()) continue;
    const double share = part.length > 0.0 ? (s - part.begin) / part.length : 0.0;
    if (part.straight) return part.from + share * (part.to - part.from);
    const double angle = share * part.angle, c = std::cos(angle), sine = std::sin(angle);
    const Vector2d arm = part.from - part.centre;
    return part.centre + Vector2d(c * arm.x() - sine * arm.y(), sine * arm.x() + c * arm.y());
  }
  return parts.back().to;
}

double Belt::wrap(int owner) const {
  double sum = 0.0;
  for (const BeltPart& part : parts)
    if (!part.straight && part.owner == owner) sum += std::abs(part.angle);
  return sum;
}

double Belt::middle(int owner) const {
  double first = -1.0, last = -1.0;
  for (const BeltPart& part : parts) {
    if (part.straight || part.owner != owner) continue;
    if (first < 0.0) first = part.begin;
    last = part.begin + part.length;
  }
  return first < 0.0 ? -1.0 : 0.5 * (first + last);
}

}  // namespace clatter::dynamics
