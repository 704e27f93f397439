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

/// A face's nodes [m], one in each row.
using FacePositions = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxFaceNodes, 3>;

/// Calls use(nodes of the face, N, x, weight, normal) at a point of a face whose nodes are at
/// `positions`: see for_each_face_point().
template <typename Nodes, typename Use>
void use_face_point(const Nodes& nodes, const FacePositions& positions, const FaceShape& shape,
                    double weight, const Use& use) {
  const Eigen::Matrix<double, 3, 2> tangent = positions.transpose() * shape.gradient;
  use(nodes, shape.value, Eigen::Vector3d(positions.transpose() * shape.value), weight,
      Eigen::Vector3d(tangent.col(0).cross(tangent.col(1))));
}

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
    for (const auto& face : block.nodes.rowwise()) {
      const FacePositions x = nodes(face, Eigen::all);
      for (size_t q = 0; q < shapes.size(); ++q)
        use_face_point(face, x, shapes[q], rule.weights(static_cast<Eigen::Index>(q)), use);
    }
  }
}

/// The same on a surface within about `radius` [m] of a point `at`, however large the faces are:
/// they are divided in four until their parts are smaller than a quarter of the radius, and parts
/// farther away are left out.
template <typename Use>
void for_each_face_point_near(const RowMatrix& nodes, const Surface& surface,
                              const Eigen::Vector3d& at, double radius, const Use& use) {
  for (const FaceBlock& block : surface.faces) {
    const FaceRule& rule = face_rule(block.type);
    const bool triangle = traits(block.type).corners == 3;
    const double low = triangle ? 0.0 : -1.0, width = triangle ? 1.0 : 2.0;  // reference face
    const Eigen::Vector2d middle = Eigen::Vector2d::Constant(triangle ? 1.0 / 3.0 : 0.0);
    for (const auto& face : block.nodes.rowwise()) {
      const FacePositions x = nodes(face, Eigen::all);
      const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
      // A part has its corner at `corner` and edges of `scale`, below 0 of triangles upside down.
      const auto visit = [&](const auto& self, const Eigen::Vector2d& corner,
                             double scale) -> void {
        const auto shape_at = [&](const Eigen::Vector2d& point) {
          return face_shape(block.type, corner + scale * (point.array() - low).matrix());
        };
        const double part = size * std::abs(scale);
        if ((x.transpose() * shape_at(middle).value - at).norm() > radius + part) return;
        if (part > 0.25 * radius) {
          const double half = 0.5 * scale, step = half * width;
          self(self, corner, half);
          self(self, corner + Eigen::Vector2d(step, 0.0), half);
          self(self, corner + Eigen::Vector2d(0.0, step), half);
          self(self, corner + Eigen::Vector2d(step, step), triangle ? -half : half);
          return;
        }
        for (Eigen::Index q = 0; q < rule.weights.size(); ++q)
          use_face_point(face, x, shape_at(rule.points.row(q).transpose()),
                         rule.weights(q) * scale * scale, use);
      };
      visit(visit, Eigen::Vector2d::Constant(low), 1.0);
    }
  }
}

}  // namespace clatter::mesh
