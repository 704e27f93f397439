// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/surface/surface_integral.hpp"

#include <algorithm>

#include "core/mesh/face_points.hpp"

namespace clatter::assembly {
SurfaceIntegrals integrate_surface(const RowMatrix& coordinates, const mesh::Surface& surface) {
  SurfaceIntegrals out;
  out.nodes = mesh::nodes_of(surface);
  const auto n = static_cast<Eigen::Index>(out.nodes.size());
  out.normal = RowMatrix::Zero(n, 3);
  out.weight = Eigen::VectorXd::Zero(n);
  const auto add = [&](const auto& face, const auto& N, const auto&, double weight,
                       const Eigen::Vector3d& normal) {
    for (Eigen::Index a = 0; a < N.size(); ++a) {
      const Eigen::Index k =
          std::lower_bound(out.nodes.begin(), out.nodes.end(), face(a)) - out.nodes.begin();
      out.normal.row(k) += weight * N(a) * normal.transpose();
      out.weight(k) += weight * N(a) * normal.norm();
    }
  };
  mesh::for_each_face_point(coordinates, surface, add);
  out.area = out.weight.sum();
  for (Eigen::Index k = 0; k < n; ++k)
    out.centroid +=
        out.weight(k) / out.area * coordinates.row(out.nodes[static_cast<size_t>(k)]).transpose();
  return out;
}

RowMatrix integrate_pressure(const RowMatrix& coordinates, const mesh::Surface& surface,
                             const Eigen::VectorXd& pressure) {
  RowMatrix sum = RowMatrix::Zero(coordinates.rows(), 3);
  const auto add = [&](const auto& face, const auto& N, const auto&, double weight,
                       const Eigen::Vector3d& normal) {
    double p = 0.0;
    for (Eigen::Index a = 0; a < N.size(); ++a) p += N(a) * pressure(face(a));
    for (Eigen::Index a = 0; a < N.size(); ++a)
      sum.row(face(a)) += weight * N(a) * p * normal.transpose();
  };
  mesh::for_each_face_point(coordinates, surface, add);
  return sum;
}

}  // namespace clatter::assembly
