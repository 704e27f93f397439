// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals over surfaces.
#include <Eigen/Core>
#include <Eigen/Geometry>
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

}  // namespace clatter::mesh
