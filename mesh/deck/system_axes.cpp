// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/system_axes.hpp"

#include <cmath>

namespace clatter::mesh::deck {
namespace {

constexpr double kOnAxis = 1e-12;  // as in core/fe/axes.cpp

}  // namespace

Eigen::Matrix3d axes_at(const System& system, const Eigen::Vector3d& x) {
  if (system.kind == System::Kind::kRectangular) return system.axes;
  const Eigen::Vector3d p = system.axes.transpose() * (x - system.origin);
  const double rho = std::hypot(p(0), p(1)), r = std::hypot(rho, p(2));
  const bool on_axis = !(rho > kOnAxis * r);
  const double c = on_axis ? 1.0 : p(0) / rho, s = on_axis ? 0.0 : p(1) / rho;
  Eigen::Matrix3d local;
  if (system.kind == System::Kind::kCylindrical) {
    local << c, -s, 0, s, c, 0, 0, 0, 1;
  } else {
    const double ct = r > 0.0 ? p(2) / r : 0.0, st = r > 0.0 ? rho / r : 1.0;
    local << st * c, ct * c, -s, st * s, ct * s, c, ct, -st, 0;
  }
  return system.axes * local;
}

}  // namespace clatter::mesh::deck
