// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face/face_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <array>
#include <limits>

#include "core/base/units.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Points = std::vector<Vector3d>;

constexpr double kSplineTolerance = 1e-5;  // of the extent: accepts exact shapes only
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Points relative to their mean and scaled by their extent, so that the problems have numbers near
/// 1.
struct Sample {
  Points x, n;
  Vector3d origin = Vector3d::Zero();
  double extent = 1.0;
};

Sample scaled(const Points& points, const Points& normals) {
  Sample s;
  for (const Vector3d& x : points) s.origin += x / static_cast<double>(points.size());
  double extent = 0.0;
  for (const Vector3d& x : points) extent = std::max(extent, (x - s.origin).norm());
  if (extent > 0.0) s.extent = extent;
  for (const Vector3d& x : points) s.x.push_back((x - s.origin) / s.extent);
  s.n = normals;
  return s;
}

Vector3d mean(const Points& list) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& v : list) sum += v;
  return sum / static_cast<double>(list.size());
}

/// The direction along which the vectors differ least from `centre`.
Vector3d least_spread(const Points& list, const Vector3d& centre) {
  Matrix3d spread = Matrix3d::Zero();
  for (const Vector3d& v : list) spread += (v - centre) * (v - centre).transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(spread).eigenvectors().col(0);
}

VectorXd least_squares(const MatrixXd& A, const VectorXd& b) {
  return A.completeOrthogonalDecomposition().solve(b);
}

SurfaceShape fit_plane(const Sample& s) {
  SurfaceShape shape{ShapeKind::kPlane};
  shape.direction = mean(s.n).normalized();
  return shape;
}

// x_i = c + r n_i in the coordinates that `P` keeps.
void fit_centre(const Sample& s, const Matrix3d& P, SurfaceShape& shape) {
  const auto count = static_cast<Eigen::Index>(s.x.size());
  MatrixXd A(3 * count, 4);
  VectorXd b(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    A.block<3, 3>(3 * i, 0) = P;
    A.block<3, 1>(3 * i, 3) = P * s.n[i];
    b.segment<3>(3 * i) = P * s.x[i];
  }
  const VectorXd found = least_squares(A, b);
  shape.point = found.head<3>();
  shape.radius = std::abs(found[3]);
}

SurfaceShape fit_sphere(const Sample& s) {
  SurfaceShape shape{ShapeKind::kSphere};
  fit_centre(s, Matrix3d::Identity(), shape);
  return shape;
}

SurfaceShape fit_cylinder(const Sample& s) {
  SurfaceShape shape{ShapeKind::kCylinder};
  const Vector3d axis = least_spread(s.n, Vector3d::Zero());
  shape.direction = axis;
  fit_centre(s, Matrix3d::Identity() - axis * axis.transpose(), shape);
  return shape;
}

SurfaceShape fit_cone(const Sample& s) {
  SurfaceShape shape{ShapeKind::kCone};
  shape.direction = least_spread(s.n, mean(s.n));
  const auto count = static_cast<Eigen::Index>(s.x.size());
  MatrixXd A(count, 3);
  VectorXd b(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<size_t>(i);
    A.row(i) = s.n[k].transpose();
    b[i] = s.n[k].dot(s.x[k]);
  }
  shape.point = least_squares(A, b);
  const double sine = std::abs(mean(s.n).dot(shape.direction));
  shape.half_angle_deg = std::asin(std::min(1.0, sine)) / kDegree;
  return shape;
}

SurfaceShape fit_torus(const Sample& s) {
  SurfaceShape shape{ShapeKind::kTorus};
  const auto count = static_cast<Eigen::Index>(s.x.size());
  MatrixXd lines(count, 6);  // a . (x_i x n_i) + m . n_i = 0, m = p x a
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<size_t>(i);
    lines.row(i) << s.x[k].cross(s.n[k]).transpose(), s.n[k].transpose();
  }
  const VectorXd line = Eigen::JacobiSVD<MatrixXd>(lines, Eigen::ComputeFullV).matrixV().col(5);
  const double length = line.head<3>().norm();
  if (length < 1e-9) return {};  // an axis at infinity: no torus
  shape.direction = line.head<3>() / length;
  const Vector3d on_axis = shape.direction.cross(line.tail<3>() / length);
  MatrixXd A(2 * count, 3);  // (rho, z) = (R, z0) + r (n_rho, n_z)
  VectorXd b(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<size_t>(i);
    const Vector3d from = s.x[k] - on_axis;
    const double z = from.dot(shape.direction);
    const Vector3d across = from - z * shape.direction;
    A.row(2 * i) << 1.0, 0.0, s.n[k].dot(across.normalized());
    A.row(2 * i + 1) << 0.0, 1.0, s.n[k].dot(shape.direction);
    b.segment<2>(2 * i) << across.norm(), z;
  }
  const VectorXd found = least_squares(A, b);
  shape.radius = std::abs(found[0]);
  shape.minor_radius = std::abs(found[2]);
  shape.point = on_axis + found[1] * shape.direction;
  return shape;
}

SurfaceShape fit(ShapeKind kind, const Sample& s) {
  switch (kind) {
    case ShapeKind::kPlane:
      return fit_plane(s);
    case ShapeKind::kCylinder:
      return fit_cylinder(s);
    case ShapeKind::kCone:
      return fit_cone(s);
    case ShapeKind::kSphere:
      return fit_sphere(s);
    case ShapeKind::kTorus:
      return fit_torus(s);
    default:
      return {kind};
  }
}

// The axis point nearest to the face, directions with their largest component positive: a unique
// form of each axis.
SurfaceShape in_part(SurfaceShape shape, const Sample& s) {
  shape.radius *= s.extent;
  shape.minor_radius *= s.extent;
  const bool along_axis = shape.kind == ShapeKind::kCylinder;
  if (along_axis) shape.point -= shape.point.dot(shape.direction) * shape.direction;
  shape.point = s.origin + s.extent * shape.point;
  Eigen::Index largest = 0;
  shape.direction.cwiseAbs().maxCoeff(&largest);
  if (shape.kind != ShapeKind::kPlane && shape.direction[largest] < 0.0) shape.direction *= -1.0;
  return shape;
}

ShapeKind kind_of(const std::string& cad_kind) {
  if (cad_kind == "Plane") return ShapeKind::kPlane;
  if (cad_kind == "Cylinder") return ShapeKind::kCylinder;
  if (cad_kind == "Cone") return ShapeKind::kCone;
  if (cad_kind == "Sphere") return ShapeKind::kSphere;
  if (cad_kind == "Torus") return ShapeKind::kTorus;
  if (cad_kind == "Surface of Revolution") return ShapeKind::kRevolved;
  if (cad_kind == "BSpline surface" || cad_kind == "Bezier surface") return ShapeKind::kSpline;
  return ShapeKind::kOther;
}

double worst_distance(const SurfaceShape& shape, const Points& points) {
  double worst = 0.0;
  for (const Vector3d& x : points) worst = std::max(worst, distance_to(shape, x));
  return worst;
}

}  // namespace

std::string name_of(ShapeKind kind) {
  constexpr std::array<const char*, 8> kNames = {"plane", "cylinder", "cone",   "sphere",
                                                 "torus", "revolved", "spline", "other"};
  return kNames[static_cast<size_t>(kind)];
}

bool is_round(ShapeKind kind) {
  return kind == ShapeKind::kCylinder || kind == ShapeKind::kCone || kind == ShapeKind::kSphere ||
         kind == ShapeKind::kTorus;
}

SurfaceShape find_shape(const std::string& cad_kind, const Points& points, const Points& normals) {
  const Sample s = scaled(points, normals);
  const ShapeKind kind = kind_of(cad_kind);
  const bool is_simple = kind <= ShapeKind::kTorus;
  if (points.size() < 4 || points.size() != normals.size()) return {kind};
  if (is_simple) return in_part(fit(kind, s), s);
  for (const ShapeKind simple : {ShapeKind::kPlane, ShapeKind::kCylinder, ShapeKind::kSphere,
                                 ShapeKind::kCone, ShapeKind::kTorus}) {
    SurfaceShape shape = in_part(fit(simple, s), s);
    if (shape.kind != simple || !(worst_distance(shape, points) <= kSplineTolerance * s.extent))
      continue;
    shape.is_spline = true;
    return shape;
  }
  return {kind};
}

void orient(SurfaceShape& shape, const Vector3d& position, const Vector3d& outward) {
  if (shape.kind == ShapeKind::kPlane && shape.direction.dot(outward) < 0.0)
    shape.direction *= -1.0;
  if (!is_round(shape.kind)) return;
  Vector3d from = position - shape.point;
  const double along = from.dot(shape.direction);
  if (shape.kind != ShapeKind::kSphere) from -= along * shape.direction;
  if (shape.kind == ShapeKind::kTorus)  // from the tube's middle
    from += along * shape.direction - shape.radius * from.normalized();
  shape.is_concave = outward.dot(from) < 0.0;
}

double distance_to(const SurfaceShape& shape, const Vector3d& x) {
  const Vector3d from = x - shape.point;
  const double along = from.dot(shape.direction);
  const double across = (from - along * shape.direction).norm();
  switch (shape.kind) {
    case ShapeKind::kPlane:
      return std::abs(along);
    case ShapeKind::kCylinder:
      return std::abs(across - shape.radius);
    case ShapeKind::kSphere:
      return std::abs(from.norm() - shape.radius);
    case ShapeKind::kCone: {
      const double angle = shape.half_angle_deg * kDegree;
      return std::abs(across * std::cos(angle) - std::abs(along) * std::sin(angle));
    }
    case ShapeKind::kTorus:
      return std::abs(std::hypot(across - shape.radius, along) - shape.minor_radius);
    default:
      return kFar;
  }
}

std::string describe(const SurfaceShape& shape, const std::string& unit) {
  const std::string name = (shape.is_spline ? "spline " : "") + name_of(shape.kind);
  switch (shape.kind) {
    case ShapeKind::kCylinder:
    case ShapeKind::kSphere:
      return fmt::format("{} of radius {:.6g} {}", name, shape.radius, unit);
    case ShapeKind::kCone:
      return fmt::format("{} of half angle {:.4g} deg", name, shape.half_angle_deg);
    case ShapeKind::kTorus:
      return fmt::format("{} of radii {:.6g} and {:.6g} {}", name, shape.radius, shape.minor_radius,
                         unit);
    default:
      return name;
  }
}

}  // namespace clatter::mesh
