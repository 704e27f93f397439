// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shape functions of all cells and faces on their reference cells; node orders of cell.hpp.
//
//   simplex   linear N_i = L_i; quadratic N_i = L_i (2 L_i - 1) at corners, N_ij = 4 L_i L_j at the
//             midpoint of edge i-j, with barycentric L
//   hex, quad products of (1 + xi_i xi) / 2; quadratic: the serendipity family
//             (Zienkiewicz and Taylor, vol. 1, ch. 8)
//   wedge     triangle times line; quadratic: serendipity (same)
//   pyramid   rational, N_i = ((1 + xi_i xi)(1 + eta_i eta) - zeta + xi_i eta_i xi eta zeta /
//             (1 - zeta)) / 4, compatible with adjacent hexahedra and tetrahedra; quadratic:
//             Bedrosian, Int. J. Numer. Meth. Engng 35 (1992). Gradients do not exist at the apex.
#include <Eigen/Core>

#include "core/mesh/cell.hpp"

namespace clatter::mesh {

/// Values and reference gradients of the n shape functions of a cell at one point.
struct CellShape {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxCellNodes, 1> value;  // n, sums to 1
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxCellNodes, 3>
      gradient;  // n x 3, columns sum to 0
};

/// The same for a face.
struct FaceShape {
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxFaceNodes, 1> value;
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMaxFaceNodes, 2> gradient;
};

/// Shape functions at the reference point `xi` (reference cells: cell.hpp).
CellShape cell_shape(CellType type, const Eigen::Vector3d& xi);

/// Triangles: 0 (0,0), 1 (1,0), 2 (0,1). Quadrilaterals: corners (-1,-1), (1,-1), (1,1), (-1,1).
FaceShape face_shape(FaceType type, const Eigen::Vector2d& xi);

/// Nodes of the reference cell, n x 3.
Eigen::Matrix<double, Eigen::Dynamic, 3> reference_nodes(CellType type);
/// The same of a face, n x 2.
Eigen::Matrix<double, Eigen::Dynamic, 2> reference_nodes(FaceType type);

}  // namespace clatter::mesh
