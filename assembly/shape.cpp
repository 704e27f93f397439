#include "assembly/shape.hpp"

#include "mesh/cell.hpp"

namespace clatter::assembly {
namespace {

template <int N, int Dim, typename Edges>
ShapeAt<N, Dim> simplex_shape(const Eigen::Matrix<double, Dim, 1>& xi, const Edges& edges) {
  constexpr int kCorners = Dim + 1;
  Eigen::Matrix<double, kCorners, 1> bary;
  bary << 1.0 - xi.sum(), xi;
  Eigen::Matrix<double, kCorners, Dim> slope;
  slope.row(0).setConstant(-1.0);
  slope.template bottomRows<Dim>().setIdentity();

  ShapeAt<N, Dim> shape;
  if constexpr (N == kCorners) {
    shape.value = bary;
    shape.gradient = slope;
  } else {
    for (int i = 0; i < kCorners; ++i) {
      shape.value(i) = bary(i) * (2.0 * bary(i) - 1.0);
      shape.gradient.row(i) = (4.0 * bary(i) - 1.0) * slope.row(i);
    }
    for (int e = 0; e < N - kCorners; ++e) {
      const int i = edges[static_cast<size_t>(e)][0];
      const int j = edges[static_cast<size_t>(e)][1];
      shape.value(kCorners + e) = 4.0 * bary(i) * bary(j);
      shape.gradient.row(kCorners + e) = 4.0 * (bary(i) * slope.row(j) + bary(j) * slope.row(i));
    }
  }
  return shape;
}

}  // namespace

template <int N>
ShapeAt<N, 3> tet_shape(const Eigen::Vector3d& xi) {
  return simplex_shape<N, 3>(xi, mesh::kTetEdges);
}

template <int N>
ShapeAt<N, 2> triangle_shape(const Eigen::Vector2d& xi) {
  return simplex_shape<N, 2>(xi, mesh::kTriangleEdges);
}

template ShapeAt<4, 3> tet_shape<4>(const Eigen::Vector3d&);
template ShapeAt<10, 3> tet_shape<10>(const Eigen::Vector3d&);
template ShapeAt<3, 2> triangle_shape<3>(const Eigen::Vector2d&);
template ShapeAt<6, 2> triangle_shape<6>(const Eigen::Vector2d&);

}  // namespace clatter::assembly
