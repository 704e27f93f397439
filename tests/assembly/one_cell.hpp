// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Single cells for tests.
#include <Eigen/Geometry>
#include <random>

#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::assembly::testing {

inline constexpr mesh::CellType kAllCells[] = {
    mesh::CellType::kTet4,     mesh::CellType::kTet10,    mesh::CellType::kHex8,
    mesh::CellType::kHex20,    mesh::CellType::kWedge6,   mesh::CellType::kWedge15,
    mesh::CellType::kPyramid5, mesh::CellType::kPyramid13};

inline mesh::CellNodes reference(mesh::CellType type) { return mesh::reference_nodes(type); }

/// All nodes moved a little: warped faces, curved edges.
inline mesh::CellNodes distorted(mesh::CellType type) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  mesh::CellNodes x = reference(type);
  for (double& value : x.reshaped()) value += shift(random);
  return x;
}

/// int x dV = 1/2 closed integral of x_i^2 n_i dS, by the faces alone.
inline Eigen::Vector3d first_moment(mesh::CellType type, const mesh::CellNodes& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const mesh::CellFace& face : mesh::traits(type).faces) {
    const int n = mesh::traits(face.type).nodes;
    Eigen::MatrixXd nodes(n, 3);
    for (int i = 0; i < n; ++i) nodes.row(i) = x.row(face.nodes[i]);
    // Degree 2 + 2 + (2 + 2) - 2 along a side at most: below the rules' 7.
    const mesh::FaceRule& rule = mesh::face_rule(face.type);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const mesh::FaceShape shape = mesh::face_shape(face.type, rule.points.row(q).transpose());
      const Eigen::Matrix<double, 3, 2> tangent = nodes.transpose() * shape.gradient;
      const Eigen::Vector3d normal = tangent.col(0).cross(tangent.col(1));
      const Eigen::Vector3d at = nodes.transpose() * shape.value;
      sum += 0.5 * rule.weights(q) * at.cwiseAbs2().cwiseProduct(normal);
    }
  }
  return sum;
}

}  // namespace clatter::assembly::testing
