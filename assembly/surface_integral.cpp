#include "assembly/surface_integral.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "assembly/quadrature.hpp"
#include "assembly/shape.hpp"

namespace clatter::assembly {
namespace {

template <int N>
struct FaceIntegrals {
  Eigen::Matrix<double, N, 3> normal = Eigen::Matrix<double, N, 3>::Zero();
  Eigen::Matrix<double, N, 1> weight = Eigen::Matrix<double, N, 1>::Zero();
};

template <int N>
FaceIntegrals<N> integrate_face(const Eigen::Matrix<double, N, 3>& x) {
  FaceIntegrals<N> sum;
  const TriangleRule& rule = triangle_rule_16();
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const ShapeAt<N, 2> shape = triangle_shape<N>(rule.points.row(q).transpose());
    const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shape.gradient;
    const Eigen::Vector3d normal = tangent.col(0).cross(tangent.col(1));
    const double weight = rule.weights(q);
    sum.normal += weight * shape.value * normal.transpose();
    sum.weight += weight * normal.norm() * shape.value;
  }
  return sum;
}

template <int N>
void add_faces(const RowMatrix& coordinates, const IndexMatrix& triangles, SurfaceIntegrals& out) {
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Eigen::Matrix<double, N, 3> x;
    Eigen::Matrix<int32_t, N, 1> local;
    for (int a = 0; a < N; ++a) {
      const int32_t node = triangles(f, a);
      x.row(a) = coordinates.row(node);
      local(a) = static_cast<int32_t>(std::lower_bound(out.nodes.begin(), out.nodes.end(), node) -
                                      out.nodes.begin());
    }
    const FaceIntegrals<N> face = integrate_face<N>(x);
    for (int a = 0; a < N; ++a) {
      out.normal.row(local(a)) += face.normal.row(a);
      out.weight(local(a)) += face.weight(a);
    }
  }
}

}  // namespace

SurfaceIntegrals integrate_surface(const RowMatrix& coordinates, const IndexMatrix& triangles) {
  SurfaceIntegrals out;
  out.nodes.assign(triangles.data(), triangles.data() + triangles.size());
  std::sort(out.nodes.begin(), out.nodes.end());
  out.nodes.erase(std::unique(out.nodes.begin(), out.nodes.end()), out.nodes.end());
  const auto n = static_cast<Eigen::Index>(out.nodes.size());
  out.normal = RowMatrix::Zero(n, 3);
  out.weight = Eigen::VectorXd::Zero(n);
  if (triangles.cols() == 3)
    add_faces<3>(coordinates, triangles, out);
  else
    add_faces<6>(coordinates, triangles, out);
  out.area = out.weight.sum();
  for (Eigen::Index k = 0; k < n; ++k)
    out.centroid +=
        out.weight(k) / out.area * coordinates.row(out.nodes[static_cast<size_t>(k)]).transpose();
  return out;
}

}  // namespace clatter::assembly
