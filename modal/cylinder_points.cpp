// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/cylinder_points.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/mesh/shape.hpp"

namespace clatter::modal {
namespace {

constexpr int kNewtonSteps = 20;
constexpr double kNewtonStep = 1e-13;  // of the reference face: converged
constexpr double kOutside = 1e-6;      // of the reference face: rounding at a common edge
constexpr double kBulge = 0.2;         // a curved face exceeds the box of its nodes by less

using FaceNodes = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, mesh::kMaxFaceNodes, 3>;

/// A face with the nodes along zero_angle, axis x zero_angle and the axis.
struct LocalFace {
  mesh::FaceType type;
  std::vector<int32_t> nodes;
  FaceNodes x;
  double low, high;     // heights
  double centre, half;  // angles
};

double turned(double angle) { return std::remainder(angle, 2.0 * M_PI); }

std::vector<LocalFace> local_faces(const RowMatrix& nodes, const mesh::Surface& surface,
                                   const CylinderAxes& axes) {
  Eigen::Matrix3d frame;
  frame << axes.zero_angle, axes.axis.cross(axes.zero_angle), axes.axis;
  std::vector<LocalFace> faces;
  for (const mesh::FaceBlock& block : surface.faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      LocalFace face{block.type, {}, FaceNodes(block.nodes.cols(), 3), 0.0, 0.0, 0.0, 0.0};
      for (Eigen::Index a = 0; a < block.nodes.cols(); ++a) {
        face.nodes.push_back(block.nodes(f, a));
        face.x.row(a) = (nodes.row(block.nodes(f, a)) - axes.axis_point.transpose()) * frame;
      }
      const double height = face.x.col(2).maxCoeff() - face.x.col(2).minCoeff();
      face.low = face.x.col(2).minCoeff() - kBulge * height;
      face.high = face.x.col(2).maxCoeff() + kBulge * height;
      const Eigen::RowVector3d mean = face.x.colwise().mean();
      face.centre = std::atan2(mean(1), mean(0));
      for (Eigen::Index a = 0; a < face.x.rows(); ++a)
        face.half = std::max(
            face.half, std::abs(turned(std::atan2(face.x(a, 1), face.x(a, 0)) - face.centre)));
      face.half *= 1.0 + 2.0 * kBulge;
      faces.push_back(std::move(face));
    }
  return faces;
}

/// How far xi lies outside the reference face; 0 inside.
double outside(mesh::FaceType type, const Eigen::Vector2d& xi) {
  if (mesh::traits(type).corners == 3) return std::max({0.0, -xi(0), -xi(1), xi(0) + xi(1) - 1.0});
  return std::max(0.0, xi.cwiseAbs().maxCoeff() - 1.0);
}

/// The reference point of the face at an angle and a height, if it lies on the face.
std::optional<Eigen::Vector2d> find_on(const LocalFace& face, double angle, double height) {
  const Eigen::Vector2d tangent(-std::sin(angle), std::cos(angle));
  const bool triangle = mesh::traits(face.type).corners == 3;
  Eigen::Vector2d xi = Eigen::Vector2d::Constant(triangle ? 1.0 / 3.0 : 0.0);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const mesh::FaceShape shape = mesh::face_shape(face.type, xi);
    const Eigen::Vector3d x = face.x.transpose() * shape.value;
    const Eigen::Matrix<double, 3, 2> slope = face.x.transpose() * shape.gradient;
    Eigen::Matrix2d J;
    J << tangent.transpose() * slope.topRows<2>(), slope.row(2);
    const Eigen::Vector2d off(tangent.dot(x.head<2>()), x(2) - height);
    const Eigen::Vector2d change = J.inverse() * off;
    if (!(change.norm() < 1e3)) return std::nullopt;
    xi -= change;
    if (change.norm() < kNewtonStep) break;
  }
  if (outside(face.type, xi) > kOutside) return std::nullopt;
  const Eigen::Vector3d x = face.x.transpose() * mesh::face_shape(face.type, xi).value;
  // The other half of the plane through the axis.
  if (!(x(0) * std::cos(angle) + x(1) * std::sin(angle) > 0.0)) return std::nullopt;
  if (std::abs(x(2) - height) > kOutside * (face.high - face.low)) return std::nullopt;
  return xi;
}

}  // namespace

Eigen::Vector3d CylinderAxes::outward(double angle) const {
  return std::cos(angle) * zero_angle + std::sin(angle) * axis.cross(zero_angle);
}

CylinderExtent extent_of(const RowMatrix& nodes, const mesh::Surface& surface,
                         const CylinderAxes& axes) {
  CylinderExtent extent{std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity(), 0.0, 0.0};
  const std::vector<int32_t> used = mesh::nodes_of(surface);
  Eigen::VectorXd radius(static_cast<Eigen::Index>(used.size()));
  for (size_t k = 0; k < used.size(); ++k) {
    const Eigen::Vector3d r = nodes.row(used[k]).transpose() - axes.axis_point;
    const double height = r.dot(axes.axis);
    radius(static_cast<Eigen::Index>(k)) = (r - height * axes.axis).norm();
    extent.low = std::min(extent.low, height);
    extent.high = std::max(extent.high, height);
  }
  extent.radius = radius.mean();
  extent.spread = (radius.array() - extent.radius).abs().maxCoeff();
  return extent;
}

CylinderPoints points_on(const RowMatrix& nodes, const mesh::Surface& surface,
                         const CylinderAxes& axes, const Eigen::VectorXd& heights,
                         const Eigen::VectorXd& angles) {
  const std::vector<LocalFace> faces = local_faces(nodes, surface, axes);
  CylinderPoints out;
  out.covered.assign(heights.size() * angles.size(), false);
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  for (Eigen::Index i = 0; i < heights.size(); ++i) {
    std::vector<const LocalFace*> level;
    for (const LocalFace& face : faces)
      if (face.low <= heights(i) && heights(i) <= face.high) level.push_back(&face);
    for (Eigen::Index j = 0; j < angles.size(); ++j) {
      const auto row = static_cast<int32_t>(i * angles.size() + j);
      for (const LocalFace* face : level) {
        if (std::abs(turned(angles(j) - face->centre)) > face->half) continue;
        const auto xi = find_on(*face, angles(j), heights(i));
        if (!xi) continue;
        const mesh::FaceShape shape = mesh::face_shape(face->type, *xi);
        const Eigen::Vector3d outward = axes.outward(angles(j));
        for (size_t a = 0; a < face->nodes.size(); ++a)
          for (int d = 0; d < 3; ++d)
            entries.emplace_back(row, 3 * face->nodes[a] + d,
                                 shape.value(static_cast<Eigen::Index>(a)) * outward(d));
        out.covered[row] = true;
        break;
      }
    }
  }
  out.radial.resize(heights.size() * angles.size(), 3 * nodes.rows());
  out.radial.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace clatter::modal
