// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/surface/surface_integral.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::assembly {
namespace {

/// Calls use(nodes of the face, N, weight, normal), n dA = weight normal, at each integration
/// point.
template <typename Use>
void for_each_area(const RowMatrix& coordinates, const mesh::Surface& surface, const Use& use) {
  for (const mesh::FaceBlock& block : surface.faces) {
    const mesh::FaceRule& rule = mesh::face_rule(block.type);
    std::vector<mesh::FaceShape> shapes;
    for (const auto& point : rule.points.rowwise())
      shapes.push_back(mesh::face_shape(block.type, point.transpose()));
    Eigen::Matrix<double, Eigen::Dynamic, 3, 0, mesh::kMaxFaceNodes, 3> x(block.nodes.cols(), 3);
    for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
      for (Eigen::Index a = 0; a < x.rows(); ++a) x.row(a) = coordinates.row(block.nodes(f, a));
      for (size_t q = 0; q < shapes.size(); ++q) {
        const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shapes[q].gradient;
        const Eigen::Vector3d normal = tangent.col(0).cross(tangent.col(1));
        use(block.nodes.row(f), shapes[q].value, rule.weights(static_cast<Eigen::Index>(q)),
            normal);
      }
    }
  }
}

}  // namespace

SurfaceIntegrals integrate_surface(const RowMatrix& coordinates, const mesh::Surface& surface) {
  SurfaceIntegrals out;
  out.nodes = mesh::nodes_of(surface);
  const auto n = static_cast<Eigen::Index>(out.nodes.size());
  out.normal = RowMatrix::Zero(n, 3);
  out.weight = Eigen::VectorXd::Zero(n);
  const auto add = [&](const auto& face, const auto& N, double weight,
                       const Eigen::Vector3d& normal) {
    for (Eigen::Index a = 0; a < N.size(); ++a) {
      const Eigen::Index k =
          std::lower_bound(out.nodes.begin(), out.nodes.end(), face(a)) - out.nodes.begin();
      out.normal.row(k) += weight * N(a) * normal.transpose();
      out.weight(k) += weight * N(a) * normal.norm();
    }
  };
  for_each_area(coordinates, surface, add);
  out.area = out.weight.sum();
  for (Eigen::Index k = 0; k < n; ++k)
    out.centroid +=
        out.weight(k) / out.area * coordinates.row(out.nodes[static_cast<size_t>(k)]).transpose();
  return out;
}

RowMatrix integrate_pressure(const RowMatrix& coordinates, const mesh::Surface& surface,
                             const Eigen::VectorXd& pressure) {
  RowMatrix sum = RowMatrix::Zero(coordinates.rows(), 3);
  const auto add = [&](const auto& face, const auto& N, double weight,
                       const Eigen::Vector3d& normal) {
    double p = 0.0;
    for (Eigen::Index a = 0; a < N.size(); ++a) p += N(a) * pressure(face(a));
    for (Eigen::Index a = 0; a < N.size(); ++a)
      sum.row(face(a)) += weight * N(a) * p * normal.transpose();
  };
  for_each_area(coordinates, surface, add);
  return sum;
}

}  // namespace clatter::assembly
