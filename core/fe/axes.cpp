// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/axes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace clatter::fe {
namespace {

constexpr double kParallel = 1e-6;  // sine of the smallest angle between x and z
constexpr double kOnAxis = 1e-12;   // of the distance from the origin: angle undefined

Eigen::Vector3d vector_or(const Config& table, std::string_view key, const Eigen::Vector3d& other) {
  if (!table.has(key)) return other;
  return Eigen::Vector3d(table.numbers(key, 3).data());
}

Eigen::Vector3d direction_or(const Config& table, std::string_view key,
                             const Eigen::Vector3d& other) {
  const Eigen::Vector3d v = vector_or(table, key, other);
  if (!(v.norm() > 0.0)) table.fail(key, "found the zero vector, expected a direction");
  return v.normalized();
}

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

Axes read_axes(const Config& table, double metre) {
  Axes axes;
  const std::string kind = table.choice("kind", {"rectangular", "cylindrical", "spherical"});
  if (kind == "cylindrical") axes.kind = Axes::Kind::kCylindrical;
  if (kind == "spherical") axes.kind = Axes::Kind::kSpherical;
  axes.origin = metre * vector_or(table, "origin", Eigen::Vector3d::Zero());
  const Eigen::Vector3d z = direction_or(table, "z", Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d fallback =
      std::abs(z.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = direction_or(table, "x", fallback);
  const Eigen::Vector3d across = x - x.dot(z) * z;
  if (across.norm() < kParallel)
    table.fail("x", "found a direction parallel to z, expected a different one");
  axes.frame << across.normalized(), z.cross(across.normalized()), z;
  return axes;
}

}  // namespace clatter::fe
