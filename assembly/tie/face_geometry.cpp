// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/tie/face_geometry.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace clatter::assembly {
namespace {

constexpr int kNewtonSteps = 30;
constexpr double kConverged = 1e-14;  // of the face's size
constexpr double kFarOutside = 4.0;   // reference coordinates beyond those of any facet point

}  // namespace

std::vector<TieFace> tie_faces(const RowMatrix& coordinates, const mesh::Surface& surface) {
  std::vector<TieFace> faces;
  for (const mesh::FaceBlock& block : surface.faces)
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      TieFace face;
      face.type = block.type;
      face.x.resize(block.nodes.cols(), 3);
      for (Eigen::Index k = 0; k < block.nodes.cols(); ++k) {
        face.nodes[k] = block.nodes(f, k);
        face.x.row(k) = coordinates.row(block.nodes(f, k));
      }
      faces.push_back(face);
    }
  return faces;
}

const std::vector<Facet>& facets_of(mesh::FaceType type) {
  static const std::vector<Facet> tri3 = {{{0, 1, 2, 0}, 3}};
  static const std::vector<Facet> tri6 = {
      {{0, 3, 5, 0}, 3}, {{3, 1, 4, 0}, 3}, {{5, 4, 2, 0}, 3}, {{3, 4, 5, 0}, 3}};
  static const std::vector<Facet> quad4 = {{{0, 1, 2, 3}, 4}};
  static const std::vector<Facet> quad8 = {{{0, 4, 7, 0}, 3},
                                           {{4, 1, 5, 0}, 3},
                                           {{5, 2, 6, 0}, 3},
                                           {{7, 6, 3, 0}, 3},
                                           {{4, 5, 6, 7}, 4}};
  switch (type) {
    case mesh::FaceType::kTri3:
      return tri3;
    case mesh::FaceType::kTri6:
      return tri6;
    case mesh::FaceType::kQuad4:
      return quad4;
    case mesh::FaceType::kQuad8:
      break;
  }
  return quad8;
}

Plane plane_of(const TieFace& face, const Facet& facet) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return face.x.row(facet.corners[k]).transpose();
  };
  Plane plane;
  for (int k = 0; k < facet.size; ++k) plane.origin += corner(k) / facet.size;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < facet.size; ++k)
    normal += (corner(k) - plane.origin).cross(corner((k + 1) % facet.size) - plane.origin);
  plane.normal = normal.normalized();
  const Eigen::Vector3d along = (corner(1) - corner(0)).normalized();
  const Eigen::Vector3d first = (along - along.dot(plane.normal) * plane.normal).normalized();
  plane.frame.row(0) = first.transpose();
  plane.frame.row(1) = plane.normal.cross(first).transpose();
  return plane;
}

Eigen::Vector2d reference_centre(mesh::FaceType type) {
  if (mesh::traits(type).corners == 3) return Eigen::Vector2d::Constant(1.0 / 3.0);
  return Eigen::Vector2d::Zero();
}

bool find_reference(const TieFace& face, const Plane& plane, const Eigen::Vector2d& at,
                    Eigen::Vector2d& xi) {
  const double size =
      (face.x.row(0) - face.x.row(1)).norm() + (face.x.row(0) - face.x.row(2)).norm();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const mesh::FaceShape shape = mesh::face_shape(face.type, xi);
    const Eigen::Vector3d position = face.x.transpose() * shape.value;
    const Eigen::Vector2d residual = plane.project(position) - at;
    const Eigen::Matrix2d jacobian = plane.frame * (face.x.transpose() * shape.gradient);
    const double det = jacobian.determinant();
    if (!(std::abs(det) > 1e-12 * jacobian.squaredNorm())) return false;
    if (residual.norm() <= kConverged * size) return true;
    const Eigen::Vector2d change = jacobian.inverse() * residual;
    xi -= change;
    if (!(xi.cwiseAbs().maxCoeff() < kFarOutside)) return false;
    if (change.norm() <= 4.0 * kConverged) return true;
  }
  return false;
}

}  // namespace clatter::assembly
