#pragma once
// Shape functions of tetrahedra and triangles on the reference cell; node orders of mesh/cell.hpp.
//
// With barycentric coordinates L_i: linear N_i = L_i; quadratic N_i = L_i (2 L_i - 1) at corners
// and N_ij = 4 L_i L_j at the middle of edge i-j (Zienkiewicz and Taylor, vol. 1, ch. 8).
#include <Eigen/Core>

namespace clatter::assembly {

/// Values and reference gradients of N nodes' shape functions in Dim coordinates.
template <int N, int Dim>
struct ShapeAt {
  Eigen::Matrix<double, N, 1> value;       // sums to 1
  Eigen::Matrix<double, N, Dim> gradient;  // columns sum to 0
};

/// Tetrahedron with N = 4 or 10 nodes at the reference point `xi`.
template <int N>
ShapeAt<N, 3> tet_shape(const Eigen::Vector3d& xi);

/// Triangle with N = 3 or 6 nodes at the reference point `xi`.
template <int N>
ShapeAt<N, 2> triangle_shape(const Eigen::Vector2d& xi);

extern template ShapeAt<4, 3> tet_shape<4>(const Eigen::Vector3d&);
extern template ShapeAt<10, 3> tet_shape<10>(const Eigen::Vector3d&);
extern template ShapeAt<3, 2> triangle_shape<3>(const Eigen::Vector2d&);
extern template ShapeAt<6, 2> triangle_shape<6>(const Eigen::Vector2d&);

}  // namespace clatter::assembly
