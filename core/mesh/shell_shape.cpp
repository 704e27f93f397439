// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/shell_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace clatter::mesh {

ShellShape shape_of_shell(std::span<const Eigen::Vector3d> x) {
  const size_t n = x.size();
  std::array<Eigen::Vector3d, 4> side;
  double longest = 0.0, shortest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < n; ++i) {
    side[i] = x[(i + 1) % n] - x[i];
    longest = std::max(longest, side[i].norm());
    shortest = std::min(shortest, side[i].norm());
  }
  const bool triangle = n == 3;
  const Eigen::Vector3d normal =
      0.5 * (triangle ? side[0].cross(side[1]) : (x[2] - x[0]).cross(x[3] - x[1]));
  const double area = normal.norm();
  ShellShape out;
  out.area = area / (longest * longest);
  out.aspect = longest / shortest;
  if (!(area > 0.0)) return out;
  const double ideal = triangle ? std::sqrt(0.75) : 1.0;  // sine of its corners
  out.corner = out.jacobian = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d &a = side[(i + n - 1) % n], &b = side[i];
    const Eigen::Vector3d own = a.cross(b);
    const double at = own.dot(normal) / area;
    if (own.norm() > 0.0) out.upright = std::min(out.upright, at / own.norm());
    out.corner = std::min(out.corner, at / area);
    out.jacobian = std::min(out.jacobian, at / (ideal * a.norm() * b.norm()));
  }
  if (!triangle) out.warp = std::abs((x[1] - x[0]).dot(normal)) / (area * std::sqrt(area));
  return out;
}

}  // namespace clatter::mesh
