// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/profile/profile_cell.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/profile/gauss_rule.hpp"

namespace clatter::dynamics {
namespace {

using Kind = ProfileCell::Kind;

double cubic_length(const Cubic& cubic, double from, double to) {
  static const GaussRule rule(8);
  const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
  double sum = 0.0;
  for (int i = 0; i < rule.size; ++i)
    sum += rule.weight[i] * cubic.derivative(middle + half * rule.node[i]).norm();
  return half * sum;
}

}  // namespace

double cell_length(const ProfileCell& cell, const std::vector<Cubic>& cubics, double y) {
  switch (cell.kind) {
    case Kind::kLine:
      return y - cell.begin;
    case Kind::kArc:
      return 2.0 * cell.radius * (std::atan(y) - std::atan(cell.begin));
    default:
      return cubic_length(cubics[cell.cubic], cell.begin, y);
  }
}

double cell_parameter(const ProfileCell& cell, const std::vector<Cubic>& cubics, double length) {
  double y = cell.begin + length;
  if (cell.kind == Kind::kArc) y = std::tan(std::atan(cell.begin) + 0.5 * length / cell.radius);
  if (cell.kind == Kind::kCubic) {
    const Cubic& cubic = cubics[cell.cubic];
    y = cell.begin + (cell.end - cell.begin) * length / cell.length;
    // Speed changes little in a cell: Newton's method gains digits from the start.
    for (int i = 0; i < 8; ++i) {
      const double step =
          (length - cubic_length(cubic, cell.begin, y)) / cubic.derivative(y).norm();
      y = std::clamp(y + step, cell.begin, cell.end);
      if (std::abs(step) < 1e-15 * (cell.end - cell.begin)) break;
    }
  }
  return std::clamp(y, cell.begin, cell.end);
}

double cell_curvature(const ProfileCell& cell, const std::vector<Cubic>& cubics, double y) {
  if (cell.kind != Kind::kCubic) return cell.curvature;
  const Cubic& cubic = cubics[cell.cubic];
  const Eigen::Vector2d d = cubic.derivative(y), dd = cubic.second_derivative(y);
  const double speed = d.norm();
  return (d.x() * dd.y() - d.y() * dd.x()) / (speed * speed * speed);
}

}  // namespace clatter::dynamics
