// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/points_spline.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

constexpr double kSamePoint = 1e-9;  // [m]

/// Rows lower x_{i-1} + diagonal x_i + upper x_{i+1} = right.
struct Tridiagonal {
  explicit Tridiagonal(size_t n) : lower(n, 0.0), diagonal(n, 1.0), upper(n, 0.0) {}

  /// Elimination without pivoting: the spline's rows are diagonally dominant but for the first and
  /// the last, whose pivots stay positive (de Boor 1978).
  std::vector<Vector2d> solve(std::vector<Vector2d> right) const {
    const size_t n = diagonal.size();
    std::vector<double> pivot = diagonal;
    for (size_t i = 1; i < n; ++i) {
      const double factor = lower[i] / pivot[i - 1];
      pivot[i] -= factor * upper[i - 1];
      right[i] -= factor * right[i - 1];
    }
    right[n - 1] /= pivot[n - 1];
    for (size_t i = n - 1; i-- > 0;) right[i] = (right[i] - upper[i] * right[i + 1]) / pivot[i];
    return right;
  }

  std::vector<double> lower, diagonal, upper;
};

/// Chords of the spline: lengths and secants from each point to the next.
struct Chords {
  std::vector<double> length;
  std::vector<Vector2d> secant;
};

Chords chords(const PointsSegment& segment) {
  const auto& points = segment.points;
  const size_t n = points.size();
  const bool directed = segment.start_direction && segment.end_direction;
  const size_t needed = segment.closed ? 3 : directed ? 2 : 4;
  if (n < needed)
    throw InputError(fmt::format("a {} curve through {} points, expected at least {}",
                                 segment.closed ? "closed" : "open", n, needed));
  for (size_t i = 0; i < n; ++i)
    if (!points[i].allFinite()) throw InputError(fmt::format("point {} is not finite", i + 1));
  Chords result;
  for (size_t i = 0; i + (segment.closed ? 0 : 1) < n; ++i) {
    const Vector2d chord = points[(i + 1) % n] - points[i];
    const double length = chord.norm();
    if (!(length > kSamePoint))
      throw InputError(fmt::format("points {} and {} are {:.3g} m apart, expected more than {:g} m",
                                   i + 1, (i + 1) % n + 1, length, kSamePoint));
    result.length.push_back(length);
    result.secant.push_back(chord / length);
  }
  return result;
}

/// Row i of the condition that the second derivative is continuous at an inner point between the
/// chords `a` and `b`.
Vector2d inner_row(const Chords& chords, size_t a, size_t b, size_t i, Tridiagonal& rows) {
  rows.lower[i] = chords.length[b];
  rows.diagonal[i] = 2.0 * (chords.length[a] + chords.length[b]);
  rows.upper[i] = chords.length[a];
  return 3.0 * (chords.length[b] * chords.secant[a] + chords.length[a] * chords.secant[b]);
}

/// Right side of an end without a direction, where the chord at the end is `h` and the next `g`.
Vector2d not_a_knot(double h, double g, const Vector2d& at_end, const Vector2d& next) {
  return ((h + 2.0 * (h + g)) * g * at_end + h * h * next) / (h + g);
}

std::vector<Vector2d> open_slopes(const PointsSegment& segment, const Chords& c) {
  const size_t n = segment.points.size(), last = n - 1;
  Tridiagonal rows(n);
  std::vector<Vector2d> right(n);
  for (size_t i = 1; i < last; ++i) right[i] = inner_row(c, i - 1, i, i, rows);
  if (segment.start_direction) {
    right[0] = segment.start_direction->normalized();
  } else {
    rows.diagonal[0] = c.length[1];
    rows.upper[0] = c.length[0] + c.length[1];
    right[0] = not_a_knot(c.length[0], c.length[1], c.secant[0], c.secant[1]);
  }
  if (segment.end_direction) {
    right[last] = segment.end_direction->normalized();
  } else {
    const double h = c.length[last - 1], g = c.length[last - 2];
    rows.diagonal[last] = g;
    rows.lower[last] = h + g;
    right[last] = not_a_knot(h, g, c.secant[last - 1], c.secant[last - 2]);
  }
  return rows.solve(std::move(right));
}

/// The two corners of the cyclic matrix are a matrix of rank one more (Sherman and Morrison 1950).
std::vector<Vector2d> closed_slopes(const PointsSegment& segment, const Chords& c) {
  const size_t n = segment.points.size(), last = n - 1;
  Tridiagonal rows(n);
  std::vector<Vector2d> right(n);
  for (size_t i = 0; i < n; ++i) right[i] = inner_row(c, (i + last) % n, i, i, rows);
  const double top = rows.lower[0], bottom = rows.upper[last], gamma = -rows.diagonal[0];
  rows.diagonal[0] -= gamma;
  rows.diagonal[last] -= top * bottom / gamma;
  std::vector<Vector2d> column(n, Vector2d::Zero());
  column[0] = Vector2d::Constant(gamma);
  column[last] = Vector2d::Constant(bottom);
  std::vector<Vector2d> slopes = rows.solve(std::move(right));
  const std::vector<Vector2d> response = rows.solve(std::move(column));
  const double share = top / gamma;
  const Vector2d factor =
      (slopes[0] + share * slopes[last]) / (1.0 + response[0].x() + share * response[last].x());
  for (size_t i = 0; i < n; ++i) slopes[i] -= factor * response[i].x();
  return slopes;
}

}  // namespace

std::vector<Cubic> points_spline(const PointsSegment& segment) {
  const Chords c = chords(segment);
  const std::vector<Vector2d> slopes =
      segment.closed ? closed_slopes(segment, c) : open_slopes(segment, c);
  std::vector<Cubic> result;
  double begin = 0.0;
  for (size_t i = 0; i < c.length.size(); ++i) {
    const double h = c.length[i];
    const Vector2d &m0 = slopes[i], &m1 = slopes[(i + 1) % slopes.size()], &d = c.secant[i];
    result.push_back({begin, begin + h, segment.points[i], m0, (3.0 * d - 2.0 * m0 - m1) / h,
                      (m0 + m1 - 2.0 * d) / (h * h)});
    begin += h;
  }
  return result;
}

Cubic bezier_cubic(const BezierSegment& segment) {
  const auto& b = segment.control;
  return {0.0,
          1.0,
          b[0],
          3.0 * (b[1] - b[0]),
          3.0 * (b[0] - 2.0 * b[1] + b[2]),
          b[3] - b[0] + 3.0 * (b[1] - b[2])};
}

}  // namespace clatter::dynamics
