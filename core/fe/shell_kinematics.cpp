// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/shell_kinematics.hpp"

#include <Eigen/Geometry>

namespace clatter::fe {
namespace {

/// Columns: directions 1 and 2, normal. An axis along the normal has no projection; then
/// direction 1 is the first side's.
Eigen::Matrix3d axes_at(const MidSurface& mid, const Eigen::Vector3d& normal) {
  constexpr double kAlong = 1e-6;  // of the axis; rounding is far below
  const auto projected = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(v - v.dot(normal) * normal);
  };
  Eigen::Vector3d first = projected(mid.axis);
  if (first.norm() < kAlong * mid.axis.norm()) first = projected(mid.x.row(1) - mid.x.row(0));
  first.normalize();
  Eigen::Matrix3d axes;
  axes << first, normal.cross(first), normal;
  return axes;
}

/// 11 22 12 (engineering) by tensor components rr ss rs, by g(a, i) = g^i . e_a.
Eigen::Matrix3d strain_map_of(const Eigen::Matrix2d& g) {
  const double a = g(0, 0), b = g(0, 1), c = g(1, 0), d = g(1, 1);
  Eigen::Matrix3d T;
  T << a * a, b * b, 2.0 * a * b, c * c, d * d, 2.0 * c * d, 2.0 * a * c, 2.0 * b * d,
      2.0 * (a * d + b * c);
  return T;
}

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d out;
  out << 0.0, v.z(), -v.y(), -v.z(), 0.0, v.x(), v.y(), -v.x(), 0.0;
  return out;
}

MidSurface::MidSurface(const ShellCell& cell)
    : type(cell.type),
      x(cell.x + cell.offset * cell.directors),
      V(cell.directors),
      axis(cell.axis) {
  if (axis.isZero(0.0)) axis = x.row(1) - x.row(0);
}

SurfacePoint::SurfacePoint(const MidSurface& mid, const Eigen::Vector2d& point) : at(point) {
  const mesh::FaceShape shape = mesh::face_shape(mid.type, at);
  h = shape.value;
  h_r = shape.gradient.col(0);
  h_s = shape.gradient.col(1);
  x_r = mid.x.transpose() * h_r;
  x_s = mid.x.transpose() * h_s;
  normal = x_r.cross(x_s);
  area = normal.norm();
  normal /= area;
  axes = axes_at(mid, normal);
  Eigen::Matrix<double, 3, 2> contravariant;
  contravariant << x_s.cross(normal) / area, normal.cross(x_r) / area;
  to_axes = axes.leftCols<2>().transpose() * contravariant;
  strain_map = strain_map_of(to_axes);
}

bool ShellTheory::is_shell() const {
  constexpr double kLeastArea = 1e-10;  // of the longest side's square
  // A director more than 60 degrees off is that of a cell which is folded over, or turned.
  constexpr double kLeastCosine = 0.5;
  double side = 0.0;
  for (Eigen::Index i = 0; i < mid_.x.rows(); ++i)
    side = std::max(side, (mid_.x.row((i + 1) % mid_.x.rows()) - mid_.x.row(i)).squaredNorm());
  return mid_.x.allFinite() && mid_.V.allFinite() && centre_.area > kLeastArea * side &&
         (mid_.V * centre_.normal).minCoeff() > kLeastCosine;
}

ShellRow ShellTheory::translation(const Eigen::Vector3d& direction,
                                  const ShellWeights& weight) const {
  ShellRow row = ShellRow::Zero(columns());
  for (Eigen::Index i = 0; i < weight.size(); ++i)
    row.segment<3>(6 * i) = weight(i) * direction.transpose();
  return row;
}

ShellRow ShellTheory::turning(const Eigen::Vector3d& direction, const ShellWeights& weight) const {
  ShellRow row = ShellRow::Zero(columns());
  for (Eigen::Index i = 0; i < weight.size(); ++i) {
    const Eigen::Vector3d V = mid_.V.row(i);
    row.segment<3>(6 * i + 3) = weight(i) * V.cross(direction).transpose();
  }
  return row;
}

ShellRows<3> ShellTheory::curvature(const SurfacePoint& p) const {
  const Eigen::Vector3d V_r = mid_.V.transpose() * p.h_r, V_s = mid_.V.transpose() * p.h_s;
  ShellRows<3> k(3, columns());
  k.row(0) = turning(p.x_r, p.h_r) + translation(V_r, p.h_r);
  k.row(1) = turning(p.x_s, p.h_s) + translation(V_s, p.h_s);
  k.row(2) = 0.5 * (turning(p.x_r, p.h_s) + turning(p.x_s, p.h_r) + translation(V_r, p.h_s) +
                    translation(V_s, p.h_r));
  return k;
}

ShellRow ShellTheory::shear(const SurfacePoint& p, int i) const {
  return turning(i == 0 ? p.x_r : p.x_s, p.h) +
         translation(mid_.V.transpose() * p.h, i == 0 ? p.h_r : p.h_s);
}

ShellRow ShellTheory::drilling(const SurfacePoint& p) const {
  const Eigen::Vector3d e1 = p.axes.col(0), e2 = p.axes.col(1);
  const Eigen::Matrix2d& g = p.to_axes;
  // (e2 . u,1 - e1 . u,2) / 2 is the rotation of the membrane.
  ShellRow row = translation(0.5 * (g(1, 0) * e1 - g(0, 0) * e2), p.h_r) +
                 translation(0.5 * (g(1, 1) * e1 - g(0, 1) * e2), p.h_s);
  for (Eigen::Index i = 0; i < p.h.size(); ++i)
    row.segment<3>(6 * i + 3) = p.h(i) * p.normal.transpose();
  return row;
}

ShellStrain ShellTheory::in_axes(const SurfacePoint& p, const ShellRows<3>& membrane,
                                 const ShellRows<3>& curvature, const ShellRows<2>& shear) const {
  const double along = p.normal.dot(mid_.V.transpose() * p.h);
  ShellStrain strain(kShellStrains, columns());
  strain.topRows<3>() = p.strain_map.lazyProduct(membrane);
  strain.middleRows<3>(3) = p.strain_map.lazyProduct(curvature);
  strain.middleRows<2>(6) = (p.to_axes / along).lazyProduct(shear);
  strain.row(8) = drilling(p);
  return strain;
}

}  // namespace clatter::fe
