// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shape functions of each cell type at its quadrature points, computed once per process.
#include <Eigen/Core>
#include <vector>

#include "core/fe/material.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::fe {

/// One quadrature point on the reference cell.
struct CellPoint {
  mesh::CellShape shape;
  Eigen::Vector3d xi;
  double weight;
};

using CellPoints = std::vector<CellPoint>;

/// Integration of the stiffness that the material chooses for a cell type.
Integration integration_of(mesh::CellType type, const IntegrationChoice& choice);

/// Points for K_e; `straight`: mid-side nodes at the midpoints of their edges.
const CellPoints& stiffness_points(mesh::CellType type, Integration integration, bool straight);

/// Points where cell stresses are evaluated: those where the derivatives of the shape functions are
/// most accurate, one order better than elsewhere (Barlow, Int. J. Numer. Meth. Engng 10, 1976):
/// the centre of a tet4, 4 of a tet10, 2 x 2 x 2 of hexahedra, 3 x 2 of wedges, 2 x 2 x 2 of
/// pyramids.
const CellPoints& stress_points(mesh::CellType type);

/// S with s_corner = S s_point, corners x points: least-squares fit of the linear shape functions
/// of the corners to values at stress_points (Hinton and Campbell, Int. J. Numer. Meth. Engng 8,
/// 1974); on a tet4 the constant value.
const Eigen::MatrixXd& stress_smoothing(mesh::CellType type);

/// Points for m, exact for N_a N_b det J.
const CellPoints& mass_points(mesh::CellType type, bool straight);

}  // namespace clatter::fe
