// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Integrals of shape functions over a surface.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/matrix.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Integrals over a surface, node by node; k = 0 ... n_s - 1 is the index among the surface's
/// nodes.
struct SurfaceIntegrals {
  std::vector<int32_t> nodes;  // n_s mesh nodes, ascending
  Eigen::VectorXd weight;      // w_k = int N_k dA [m2]: consistent area, sums to `area`
  RowMatrix normal;            // n_s x 3: int N_k n dA [m2], n outward
  double area = 0.0;           // [m2]
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  // [m]
};

/// `coordinates` n x 3 [m]. The corner nodes of a flat quadratic triangle get w = 0 and its
/// mid-side nodes a third of the area each, the corners of a flat 8-node square -1/12 and its
/// mid-side nodes 1/3: so a constant pressure is reproduced exactly.
SurfaceIntegrals integrate_surface(const RowMatrix& coordinates, const mesh::Surface& surface);

/// int N_a p n dA [N] at all nodes (n x 3, n outward) of a pressure p [Pa] given at the nodes (n,
/// of which those of the surface are used), between them by the shape functions of the faces.
RowMatrix integrate_pressure(const RowMatrix& coordinates, const mesh::Surface& surface,
                             const Eigen::VectorXd& pressure);

}  // namespace clatter::assembly
