// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cells of a profile: parts of its segments that turn little.
#include <Eigen/Core>
#include <vector>

#include "dynamics/profile/points_spline.hpp"

namespace clatter::dynamics {

/// A part of a profile over a parameter y, which is
///   of a line the length from its start [m],
///   of an arc tan(psi / 2), psi the angle from its middle, so that points need no trigonometry,
///   of a cubic that of the curve (points_spline.hpp).
struct ProfileCell {
  enum class Kind { kLine, kArc, kCubic };

  Kind kind = Kind::kLine;
  int curve = 0;                  // cells of one smooth curve with one parameter share a number
  int cubic = 0;                  // of a cubic: which one
  double begin = 0.0, end = 0.0;  // of the parameter
  double start = 0.0;             // arc length where the cell begins [m]
  double length = 0.0;            // [m]
  double curvature = 0.0;         // of lines and arcs, positive where the profile turns left [1/m]
  double radius = 0.0;            // of an arc [m]
  // Line: its start and direction. Arc: its centre, the direction to its middle, and the running
  // direction there.
  Eigen::Vector2d origin = Eigen::Vector2d::Zero(), first = Eigen::Vector2d::Zero(),
                  second = Eigen::Vector2d::Zero();
};

/// A point of a curve, its derivative by the parameter, the length of that and its own derivative.
struct CurvePoint {
  Eigen::Vector2d position, derivative;
  double speed, stretch;
};

inline CurvePoint line_point(const ProfileCell& cell, double y) {
  return {cell.origin + y * cell.first, cell.first, 1.0, 0.0};
}

inline CurvePoint arc_point(const ProfileCell& cell, double y) {
  const double q = 1.0 / (1.0 + y * y);
  const double cosine = (1.0 - y * y) * q, sine = 2.0 * y * q;
  const double speed = 2.0 * cell.radius * q;
  return {cell.origin + cell.radius * (cosine * cell.first + sine * cell.second),
          speed * (cosine * cell.second - sine * cell.first), speed, -speed * sine};
}

inline CurvePoint cubic_point(const Cubic& cubic, double y) {
  const Eigen::Vector2d derivative = cubic.derivative(y);
  const double speed = derivative.norm();
  return {cubic.position(y), derivative, speed, derivative.dot(cubic.second_derivative(y)) / speed};
}

inline CurvePoint cell_point(const ProfileCell& cell, const std::vector<Cubic>& cubics, double y) {
  switch (cell.kind) {
    case ProfileCell::Kind::kLine:
      return line_point(cell, y);
    case ProfileCell::Kind::kArc:
      return arc_point(cell, y);
    default:
      return cubic_point(cubics[cell.cubic], y);
  }
}

/// Arc length from the cell's begin to the parameter [m].
double cell_length(const ProfileCell& cell, const std::vector<Cubic>& cubics, double y);
/// Its inverse.
double cell_parameter(const ProfileCell& cell, const std::vector<Cubic>& cubics, double length);
/// Curvature at the parameter, positive where the profile turns left [1/m].
double cell_curvature(const ProfileCell& cell, const std::vector<Cubic>& cubics, double y);

}  // namespace clatter::dynamics
