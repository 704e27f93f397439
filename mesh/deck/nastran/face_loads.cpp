// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures that vary over a face, or act along a vector: f_a = integral of N_a p d dA with p
// linear between the corners and d inward or along the vector.
#include <Eigen/Geometry>

#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {

using Eigen::Vector3d;

std::vector<Step::NodalForce> forces_on_face(Model& model, const RawPressure& raw,
                                             const LoadedFace& face) {
  const FaceTraits& shape = traits(face.type);
  const FaceType linear = shape.corners == 3 ? FaceType::kTri3 : FaceType::kQuad4;
  Eigen::MatrixX3d x(shape.nodes, 3);
  for (int a = 0; a < shape.nodes; ++a) x.row(a) = model.deck.mesh.nodes.row(face.nodes[a]);
  Eigen::VectorXd p(shape.corners);
  for (int c = 0; c < shape.corners; ++c) p((face.first + c) % shape.corners) = raw.values[c];
  Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(shape.nodes, 3);
  const FaceRule& rule = face_rule(face.type);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector2d xi = rule.points.row(q).transpose();
    const FaceShape at = face_shape(face.type, xi);
    const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * at.gradient;
    const Vector3d normal = tangent.col(0).cross(tangent.col(1));
    Vector3d direction = -normal;
    if (raw.along_vector()) {
      const Vector3d position = x.transpose() * at.value;
      direction = normal.norm() * (model.systems.directions(raw.system, position, raw.origin) *
                                   vector(raw.direction).normalized());
    }
    force +=
        (rule.weights(q) * p.dot(face_shape(linear, xi).value)) * at.value * direction.transpose();
  }
  model.spend(64 * shape.nodes, raw.origin);
  std::vector<Step::NodalForce> out;
  for (int a = 0; a < shape.nodes; ++a)
    for (int d = 0; d < 3; ++d)
      if (force(a, d) != 0.0) out.push_back({face.nodes[a], d, force(a, d), {}});
  return out;
}

}  // namespace clatter::mesh::deck::nastran
