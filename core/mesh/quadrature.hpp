// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Quadrature on the reference cells and faces of cell.hpp and shape.hpp.
#include <Eigen/Core>

#include "core/mesh/cell.hpp"

namespace clatter::mesh {

/// Points and weights on a reference cell; weights sum to its volume: 1/6 tetrahedron, 8
/// hexahedron, 1 wedge, 4/3 pyramid.
struct CellRule {
  Eigen::Matrix<double, Eigen::Dynamic, 3> points;
  Eigen::VectorXd weights;
};

/// Points and weights on a reference face; weights sum to 1/2 (triangle) or 4.
struct FaceRule {
  Eigen::Matrix<double, Eigen::Dynamic, 2> points;
  Eigen::VectorXd weights;
};

/// One point, exact for degree 1: stiffness of a tet4, whose strain is constant.
const CellRule& tet_rule_1();
/// Four points, exact for degree 2: stiffness of a straight tet10, whose strain is linear
/// (Hammer, Marlowe, Stroud 1956).
const CellRule& tet_rule_4();
/// Fourteen points, all weights positive, exact for degree 5: stiffness of a curved tet10.
/// (Walkington, "Quadrature on simplices of arbitrary dimension", 2000.)
const CellRule& tet_rule_14();
/// Sixty-four points, exact for degree 7: the mass of a curved tet10, whose integrand
/// N_a N_b det J has degree 2 + 2 + 3. Conical product of Gauss-Jacobi rules (Stroud 1971).
const CellRule& tet_rule_64();

/// n points per direction (Gauss-Legendre, 1 <= n <= 5): exact for degree 2 n - 1 in each
/// coordinate.
const CellRule& hex_rule(int n);
/// Triangle rule times n points along the axis. `triangle` 1, 3 or 6 points: exact for degree 1, 2
/// or 4 (the last by Dunavant, Int. J. Numer. Meth. Engng 21, 1985); 25: degree 9.
const CellRule& wedge_rule(int triangle, int n);
/// n^3 points (1 <= n <= 5), conical product with Gauss-Jacobi points in the direction of the apex:
/// exact for xi^i eta^j zeta^k with i, j <= 2 n - 1 and i + j + k <= 2 n - 1, and for the rational
/// functions of shape.hpp, which are polynomials in xi / (1 - zeta), eta / (1 - zeta), zeta.
const CellRule& pyramid_rule(int n);

/// The finest rule of the cell type: 64 points for tetrahedra, five per direction for the others.
const CellRule& fine_rule(CellType type);

/// Six points, exact for degree 4 (Dunavant, Int. J. Numer. Meth. Engng 21, 1985), and
/// Gauss-Legendre, 2 x 2 and 3 x 3 points: of shells.
const FaceRule& triangle_rule_6();
const FaceRule& quad_rule_4();
const FaceRule& quad_rule_9();
/// Sixteen points, exact for degree 7: used for all triangles (N_a n has degree 4 on a curved
/// triangle, N_a dA is not polynomial there). Conical product of Gauss-Jacobi rules.
const FaceRule& triangle_rule_16();
/// Gauss-Legendre, 4 x 4 points: exact for degree 7 in each coordinate, more than needed for N_a n
/// on a curved quadrilateral (5).
const FaceRule& quad_rule_16();
/// The rule for the face type.
const FaceRule& face_rule(FaceType type);

}  // namespace clatter::mesh
