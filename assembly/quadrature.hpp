#pragma once
// Quadrature on the reference tetrahedron and triangle.
#include <Eigen/Core>

namespace clatter::assembly {

/// Points and weights on the tetrahedron with corners 0, e1, e2, e3 (weights sum to 1/6).
struct TetRule {
  Eigen::Matrix<double, Eigen::Dynamic, 3> points;
  Eigen::VectorXd weights;
};

/// Points and weights on the triangle with corners 0, e1, e2 (weights sum to 1/2).
struct TriangleRule {
  Eigen::Matrix<double, Eigen::Dynamic, 2> points;
  Eigen::VectorXd weights;
};

/// One point, exact for degree 1: stiffness of a tet4, whose strain is constant.
const TetRule& tet_rule_1();
/// Four points, exact for degree 2: stiffness of a straight tet10, whose strain is linear
/// (Hammer, Marlowe, Stroud 1956).
const TetRule& tet_rule_4();
/// Fourteen points, all weights positive, exact for degree 5: stiffness of a curved tet10.
/// (Walkington, "Quadrature on simplices of arbitrary dimension", 2000.)
const TetRule& tet_rule_14();
/// Sixty-four points, exact for degree 7: the mass of a curved tet10, whose integrand
/// N_a N_b det J has degree 2 + 2 + 3. Conical product of Gauss-Jacobi rules (Stroud 1971).
const TetRule& tet_rule_64();

/// Sixteen points, exact for degree 7: everything on surfaces (N_a n has degree 4 on a curved
/// triangle, N_a dA is not polynomial there). Conical product of Gauss-Jacobi rules.
const TriangleRule& triangle_rule_16();

}  // namespace clatter::assembly
