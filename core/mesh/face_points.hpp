// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over surfaces.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <map>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::mesh {

/// face_rule(type) on each of the n^2 equal parts of the face, n >= 1 along an edge: for what
/// varies within a face.
FaceRule divided_face_rule(FaceType type, int n);

/// Calls use(nodes of the face, N, x, weight, normal) at each integration point of a surface: shape
/// functions and position [m] there; n dA = weight normal, out of the cell.
/// @param nodes n_nodes x 3 [m]
/// @param parts parts(x) of a face whose nodes are at x (k x 3 [m]): into how many parts its edges
///     are divided, 1 or more, or 0 to leave it out
template <typename Parts, typename Use>
void for_each_face_point(const RowMatrix& nodes, const Surface& surface, const Parts& parts,
                         const Use& use) {
  struct Rule {
    Eigen::VectorXd weights;
    std::vector<FaceShape> shapes;
  };
  for (const FaceBlock& block : surface.faces) {
    std::map<int, Rule> rules;
    Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxFaceNodes, 3> x(block.nodes.cols(), 3);
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      for (Eigen::Index a = 0; a < x.rows(); ++a) x.row(a) = nodes.row(block.nodes(f, a));
      const int n = parts(x);
      if (n == 0) continue;
      Rule& rule = rules[n];
      if (rule.shapes.empty()) {
        const FaceRule points = divided_face_rule(block.type, n);
        rule.weights = points.weights;
        for (const auto& point : points.points.rowwise())
          rule.shapes.push_back(face_shape(block.type, point.transpose()));
      }
      for (size_t q = 0; q < rule.shapes.size(); ++q) {
        const FaceShape& shape = rule.shapes[q];
        const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shape.gradient;
        use(block.nodes.row(f), shape.value, Eigen::Vector3d(x.transpose() * shape.value),
            rule.weights(static_cast<Eigen::Index>(q)),
            Eigen::Vector3d(tangent.col(0).cross(tangent.col(1))));
      }
    }
  }
}

/// The same on undivided faces.
template <typename Use>
void for_each_face_point(const RowMatrix& nodes, const Surface& surface, const Use& use) {
  for_each_face_point(
      nodes, surface, [](const auto&) { return 1; }, use);
}

}  // namespace clatter::mesh
