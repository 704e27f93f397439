// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over surfaces.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::mesh {

/// Calls use(nodes of the face, N, x, weight, normal) at each integration point of a surface: shape
/// functions and position [m] there; n dA = weight normal, out of the cell.
/// @param nodes n_nodes x 3 [m]
template <typename Use>
void for_each_face_point(const RowMatrix& nodes, const Surface& surface, const Use& use) {
  for (const FaceBlock& block : surface.faces) {
    const FaceRule& rule = face_rule(block.type);
    std::vector<FaceShape> shapes;
    for (const auto& point : rule.points.rowwise())
      shapes.push_back(face_shape(block.type, point.transpose()));
    Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxFaceNodes, 3> x(block.nodes.cols(), 3);
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      for (Eigen::Index a = 0; a < x.rows(); ++a) x.row(a) = nodes.row(block.nodes(f, a));
      for (size_t q = 0; q < shapes.size(); ++q) {
        const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shapes[q].gradient;
        use(block.nodes.row(f), shapes[q].value, Eigen::Vector3d(x.transpose() * shapes[q].value),
            rule.weights(static_cast<Eigen::Index>(q)),
            Eigen::Vector3d(tangent.col(0).cross(tangent.col(1))));
      }
    }
  }
}

/// The same on a surface within about `radius` [m] of a point `at`, however large the faces are:
/// they are divided in four until their parts are smaller than a quarter of the radius, and parts
/// farther away are left out.
template <typename Use>
void for_each_face_point_near(const RowMatrix& nodes, const Surface& surface,
                              const Eigen::Vector3d& at, double radius, const Use& use) {
  const double smallest = 0.25 * radius;
  for (const FaceBlock& block : surface.faces) {
    const FaceRule& rule = face_rule(block.type);
    const bool triangle = traits(block.type).corners == 3;
    const double low = triangle ? 0.0 : -1.0,
                 width = triangle ? 1.0 : 2.0;  // of the reference face
    Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxFaceNodes, 3> x(block.nodes.cols(), 3);
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      for (Eigen::Index a = 0; a < x.rows(); ++a) x.row(a) = nodes.row(block.nodes(f, a));
      const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
      // A part has its corner at `corner` and edges of `scale`, below 0 of triangles upside down.
      const auto visit = [&](const auto& self, const Eigen::Vector2d& corner,
                             double scale) -> void {
        const auto point_of = [&](const Eigen::Vector2d& point) -> Eigen::Vector2d {
          return corner + scale * (point.array() - low).matrix();
        };
        const Eigen::Vector2d middle = Eigen::Vector2d::Constant(triangle ? 1.0 / 3.0 : 0.0);
        const double part = size * std::abs(scale);
        const Eigen::Vector3d centre =
            x.transpose() * face_shape(block.type, point_of(middle)).value;
        if ((centre - at).norm() > radius + part) return;
        if (part > smallest) {
          const double half = 0.5 * scale, step = half * width;
          self(self, corner, half);
          self(self, corner + Eigen::Vector2d(step, 0.0), half);
          self(self, corner + Eigen::Vector2d(0.0, step), half);
          const Eigen::Vector2d opposite = corner + Eigen::Vector2d(step, step);
          self(self, opposite, triangle ? -half : half);
          return;
        }
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
          const FaceShape shape = face_shape(block.type, point_of(rule.points.row(q).transpose()));
          const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shape.gradient;
          use(block.nodes.row(f), shape.value, Eigen::Vector3d(x.transpose() * shape.value),
              rule.weights(q) * scale * scale,
              Eigen::Vector3d(tangent.col(0).cross(tangent.col(1))));
        }
      };
      visit(visit, Eigen::Vector2d::Constant(low), 1.0);
    }
  }
}

}  // namespace clatter::mesh
