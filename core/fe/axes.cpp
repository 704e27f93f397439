// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/axes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace clatter::fe {
namespace {

constexpr double kParallel = 1e-6;  // sine of the smallest angle between x and z
constexpr double kOnAxis = 1e-12;   // of the distance from the origin: angle undefined

}  // namespace

Eigen::Matrix3d Axes::at(const Eigen::Vector3d& position) const {
  if (kind == Kind::kRectangular) return frame;
  const Eigen::Vector3d r = frame.transpose() * (position - origin);
  const double across = std::hypot(r.x(), r.y());
  const bool on_axis = !(across > kOnAxis * r.norm());
  const Eigen::Vector3d out =
      on_axis ? Eigen::Vector3d::UnitX() : Eigen::Vector3d(r.x() / across, r.y() / across, 0.0);
  const Eigen::Vector3d around(-out.y(), out.x(), 0.0);
  Eigen::Matrix3d local;
  if (kind == Kind::kCylindrical) {
    local << out, around, Eigen::Vector3d::UnitZ();
  } else {
    const double polar = r.norm() > 0.0 ? std::atan2(across, r.z()) : 0.5 * std::numbers::pi;
    local.col(0) = std::sin(polar) * out + std::cos(polar) * Eigen::Vector3d::UnitZ();
    local.col(1) = std::cos(polar) * out - std::sin(polar) * Eigen::Vector3d::UnitZ();
    local.col(2) = around;
  }
  return frame * local;
}

void finish(AxesTable& table) {
  const Eigen::Vector3d& z = table.z;
  const Eigen::Vector3d x = table.x                 ? *table.x
                            : std::abs(z.x()) < 0.9 ? Eigen::Vector3d::UnitX()
                                                    : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  const Eigen::Vector3d across = x - x.dot(z) * z;
  if (across.norm() < kParallel)
    table.source.fail("x", "found a direction parallel to z, expected a different one");
  table.axes.frame << across.normalized(), z.cross(across.normalized()), z;
}

const keys::Keys<AxesTable>& axes_keys() {
  static const keys::Keys<AxesTable> keys(
      "system", "axes for directions", [](auto& key, AxesTable& table) {
        key.source(table.source);
        key.choice("kind", table.axes.kind,
                   {{"rectangular", Axes::Kind::kRectangular},
                    {"cylindrical", Axes::Kind::kCylindrical},
                    {"spherical", Axes::Kind::kSpherical}},
                   "directions are x, y, z; radial, tangential, axial; or radial, meridian, "
                   "latitude");
        key.vector("origin", table.axes.origin, {}, "origin of the axes").in_length_unit();
        key.direction("z", table.z, "third axis");
        key.direction("x", table.x,
                      "direction near the first axis; x, or y near a third axis along x, without "
                      "it");
        key.check([](const Config&, AxesTable& t) { finish(t); });
      });
  return keys;
}

}  // namespace clatter::fe
