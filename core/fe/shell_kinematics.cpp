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
      moving_V(cell.directors),
      axis(cell.axis) {
  if (type == mesh::FaceType::kQuad8) {
    moving_V.conservativeResize(kShellNodes + 1, Eigen::NoChange);
    moving_V.row(kShellNodes) =
        mesh::face_shape(type, Eigen::Vector2d::Zero()).value.transpose() * V;
  }
  if (axis.isZero(0.0)) axis = x.row(1) - x.row(0);
}

SurfacePoint::SurfacePoint(const MidSurface& mid, const Eigen::Vector2d& point) : at(point) {
  const mesh::FaceShape shape = mesh::face_shape(mid.type, at);
  h = shape.value;
  h_r = shape.gradient.col(0);
  h_s = shape.gradient.col(1);
  m = h;
  m_r = h_r;
  m_s = h_s;
  if (mid.type == mesh::FaceType::kQuad8) add_centre();
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

void SurfacePoint::add_centre() {
  const double r = at(0), s = at(1);
  const auto add = [](ShellWeights& weights, double of_centre) {
    weights.conservativeResize(kShellNodes + 1);
    weights(kShellNodes) = of_centre;
  };
  add(m, (1.0 - r * r) * (1.0 - s * s));
  add(m_r, -2.0 * r * (1.0 - s * s));
  add(m_s, -2.0 * s * (1.0 - r * r));
}

// At the centre, and of a quadratic cell at all points.
bool ShellTheory::is_shell() const {
  constexpr double kLeastArea = 1e-10;  // of the longest side's square
  // A director more than 60 degrees off is that of a cell which is folded over, or turned.
  constexpr double kLeastCosine = 0.5;
  if (!mid_.x.allFinite() || !mid_.V.allFinite()) return false;
  const mesh::FaceTraits& cell = mesh::traits(mid_.type);
  double side = 0.0;
  for (int i = 0; i < cell.corners; ++i)
    side = std::max(side, (mid_.x.row((i + 1) % cell.corners) - mid_.x.row(i)).squaredNorm());
  if (!(centre_.area > kLeastArea * side && (mid_.V * centre_.normal).minCoeff() > kLeastCosine))
    return false;
  if (cell.order == 1) return true;
  const auto& points = rule().points;
  for (Eigen::Index q = 0; q < points.rows(); ++q) {
    const SurfacePoint p(mid_, points.row(q).transpose());
    if (!(p.area > kLeastArea * side && p.normal.dot(mid_.V.transpose() * p.h) > kLeastCosine))
      return false;
  }
  return true;
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
    const Eigen::Vector3d V = mid_.moving_V.row(i);
    const Eigen::RowVector3d by_theta = weight(i) * V.cross(direction).transpose();
    if (i < mid_.x.rows())
      row.segment<3>(6 * i + 3) = by_theta;
    else
      row.segment<2>(6 * i + 3) = by_theta * centre_.axes.leftCols<2>();
  }
  return row;
}

ShellRows<3> ShellTheory::membrane(const SurfacePoint& p) const {
  ShellRows<3> e(3, columns());
  e.row(0) = translation(p.x_r, p.m_r);
  e.row(1) = translation(p.x_s, p.m_s);
  e.row(2) = 0.5 * (translation(p.x_r, p.m_s) + translation(p.x_s, p.m_r));
  return e;
}

ShellRows<3> ShellTheory::curvature(const SurfacePoint& p) const {
  const Eigen::Vector3d V_r = mid_.V.transpose() * p.h_r, V_s = mid_.V.transpose() * p.h_s;
  ShellRows<3> k(3, columns());
  k.row(0) = turning(p.x_r, p.m_r) + translation(V_r, p.m_r);
  k.row(1) = turning(p.x_s, p.m_s) + translation(V_s, p.m_s);
  k.row(2) = 0.5 * (turning(p.x_r, p.m_s) + turning(p.x_s, p.m_r) + translation(V_r, p.m_s) +
                    translation(V_s, p.m_r));
  return k;
}

ShellRow ShellTheory::shear(const SurfacePoint& p, int i) const {
  return turning(i == 0 ? p.x_r : p.x_s, p.m) +
         translation(mid_.V.transpose() * p.h, i == 0 ? p.m_r : p.m_s);
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

void ShellTheory::add_bubble(const Eigen::Vector3d& direction, double factor, ShellRow& row) const {
  const Eigen::Vector3d V = mid_.V.transpose() * centre_.h;
  row.tail<2>() += factor * V.cross(direction).transpose() * centre_.axes.leftCols<2>();
}

void ShellTheory::add_bubble(const SurfacePoint& p, ShellRows<3>& curvature) const {
  const double r = p.at(0), s = p.at(1);
  const double q_r = 27.0 * s * (1.0 - 2.0 * r - s), q_s = 27.0 * r * (1.0 - r - 2.0 * s);
  ShellRow rr = curvature.row(0), ss = curvature.row(1), rs = curvature.row(2);
  add_bubble(p.x_r, q_r, rr);
  add_bubble(p.x_s, q_s, ss);
  add_bubble(p.x_r, 0.5 * q_s, rs);
  add_bubble(p.x_s, 0.5 * q_r, rs);
  curvature << rr, ss, rs;
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
