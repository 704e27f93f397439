// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of a cylinder surface of the mesh at given heights and angles.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"
#include "core/base/sparse.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::modal {

/// The axis of a cylinder surface. Angles are right-handed about `axis`; heights are
/// (x - axis_point) . axis.
struct CylinderAxes {
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();   // [m]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();        // unit vector
  Eigen::Vector3d zero_angle = Eigen::Vector3d::UnitX();  // unit vector, normal to the axis

  /// Unit vector away from the axis at an angle [rad].
  Eigen::Vector3d outward(double angle) const;
};

/// Extent of a surface about an axis.
struct CylinderExtent {
  double low = 0.0, high = 0.0;  // heights of its nodes [m]
  double radius = 0.0;           // mean distance of the nodes from the axis [m]
  double spread = 0.0;           // largest difference from it [m]
};
CylinderExtent extent_of(const RowMatrix& nodes, const mesh::Surface& surface,
                         const CylinderAxes& axes);

/// Where the half-planes of the angles cut the surface at the heights; point (i, j) of height i and
/// angle j is row i * n_angles + j.
struct CylinderPoints {
  SparseMatrix radial;        // points x 3 n_nodes: outward displacement u . e_r from nodal ones;
                              // empty rows where the surface has no face
  std::vector<bool> covered;  // points
};

/// On each face x(xi) = sum N_a(xi) x_a the point with the height and the angle is found by
/// Newton's method; its displacement is sum N_a u_a, as in the finite element solution, without any
/// mean.
CylinderPoints points_on(const RowMatrix& nodes, const mesh::Surface& surface,
                         const CylinderAxes& axes, const Eigen::VectorXd& heights,
                         const Eigen::VectorXd& angles);

}  // namespace clatter::modal
