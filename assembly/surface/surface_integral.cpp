// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/surface/surface_integral.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"

namespace clatter::assembly {
namespace {

void add_faces(const RowMatrix& coordinates, const mesh::FaceBlock& block, SurfaceIntegrals& out) {
  const mesh::FaceRule& rule = mesh::face_rule(block.type);
  std::vector<mesh::FaceShape> shapes;
  for (const auto& point : rule.points.rowwise())
    shapes.push_back(mesh::face_shape(block.type, point.transpose()));
  const Eigen::Index n = block.nodes.cols();
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, mesh::kMaxFaceNodes, 3> x(n, 3);
  for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
    std::array<Eigen::Index, mesh::kMaxFaceNodes> local{};
    for (Eigen::Index a = 0; a < n; ++a) {
      const int32_t node = block.nodes(f, a);
      x.row(a) = coordinates.row(node);
      local[static_cast<size_t>(a)] =
          std::lower_bound(out.nodes.begin(), out.nodes.end(), node) - out.nodes.begin();
    }
    for (size_t q = 0; q < shapes.size(); ++q) {
      const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * shapes[q].gradient;
      const Eigen::Vector3d normal = tangent.col(0).cross(tangent.col(1));
      const double weight = rule.weights(static_cast<Eigen::Index>(q));
      for (Eigen::Index a = 0; a < n; ++a) {
        const Eigen::Index k = local[static_cast<size_t>(a)];
        out.normal.row(k) += weight * shapes[q].value(a) * normal.transpose();
        out.weight(k) += weight * shapes[q].value(a) * normal.norm();
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
  for (const mesh::FaceBlock& block : surface.faces) add_faces(coordinates, block, out);
  out.area = out.weight.sum();
  for (Eigen::Index k = 0; k < n; ++k)
    out.centroid +=
        out.weight(k) / out.area * coordinates.row(out.nodes[static_cast<size_t>(k)]).transpose();
  return out;
}

}  // namespace clatter::assembly
