// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/skin.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/base/error.hpp"
#include "recover/skin/triangle6.hpp"

namespace clatter::recover {
namespace {

/// Parameters (u, v) of the six nodes.
constexpr double kNodeU[6] = {0, 1, 0, 0.5, 0.5, 0};
constexpr double kNodeV[6] = {0, 0, 1, 0, 0.5, 0.5};

void measure_face(const RowMatrix& nodes, const IndexMatrix& triangles, int64_t face,
                  SkinGeometry& geometry, Eigen::Vector3d& total) {
  const Coordinates6 x = face_coordinates(nodes, triangles, face);
  Eigen::Vector3d vector_area = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  Shape6 squares = Shape6::Zero();
  double area = 0.0;
  for (const FacePoint& point : face_points(x)) {
    const double dS = point.area_vector.norm();
    const Eigen::Vector3d at = x.transpose() * point.shape;
    area += dS;
    vector_area += point.area_vector;
    moment += dS * at;
    squares += dS * point.shape.cwiseAbs2();
    geometry.volume += at.dot(point.area_vector) / 3.0;
  }
  if (!(area > 0.0) || !(vector_area.norm() > 1e-6 * area))
    throw InputError(
        fmt::format("skin: triangle {}: area {} m2, expected a positive area", face, area));
  geometry.face_area[face] = area;
  geometry.face_normal.row(face) = vector_area.normalized();
  geometry.face_centre.row(face) = moment / area;
  geometry.area += area;
  total += vector_area;
  for (int a = 0; a < 6; ++a) {
    const Eigen::Matrix<double, 3, 2> t = x.transpose() * shape_gradients(kNodeU[a], kNodeV[a]);
    const int32_t node = triangles(face, a);
    geometry.node_normal.row(node) += area * t.col(0).cross(t.col(1)).normalized();
    geometry.node_area[node] += area * squares[a] / squares.sum();
  }
}

}  // namespace

SkinGeometry measure_skin(const RowMatrix& nodes, const IndexMatrix& triangles) {
  SkinGeometry geometry;
  const int64_t n_faces = triangles.rows(), n_nodes = nodes.rows();
  geometry.face_area.setZero(n_faces);
  geometry.face_normal.setZero(n_faces, 3);
  geometry.face_centre.setZero(n_faces, 3);
  geometry.node_normal.setZero(n_nodes, 3);
  geometry.node_area.setZero(n_nodes);
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (int64_t face = 0; face < n_faces; ++face)
    measure_face(nodes, triangles, face, geometry, total);
  for (int64_t node = 0; node < n_nodes; ++node) geometry.node_normal.row(node).normalize();
  geometry.closure = geometry.area > 0.0 ? total.norm() / geometry.area : 0.0;
  // An open skin encloses no volume, so only a closed one can be found inside out.
  if (n_faces > 0 && geometry.closure < 1e-9 && geometry.volume <= 0.0)
    throw InputError(fmt::format("skin: enclosed volume {:.4g} m3, expected outward triangles",
                                 geometry.volume));
  return geometry;
}

SparseRows face_normal_operator(const RowMatrix& nodes, const IndexMatrix& triangles,
                                const SkinGeometry& geometry) {
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  entries.reserve(static_cast<size_t>(triangles.rows()) * 18);
  for (int32_t face = 0; face < triangles.rows(); ++face) {
    Eigen::Matrix<double, 6, 3> weights = Eigen::Matrix<double, 6, 3>::Zero();
    for (const FacePoint& point : face_points(face_coordinates(nodes, triangles, face)))
      weights += point.shape * point.area_vector.transpose();
    weights /= geometry.face_area[face];
    for (int a = 0; a < 6; ++a)
      for (int d = 0; d < 3; ++d)
        entries.emplace_back(face, 3 * triangles(face, a) + d, weights(a, d));
  }
  SparseRows result(triangles.rows(), 3 * nodes.rows());
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

NormalSamples normal_samples(const RowMatrix& nodes, const IndexMatrix& triangles,
                             const std::vector<int32_t>& faces, int64_t begin, int64_t end) {
  NormalSamples samples;
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  entries.reserve(static_cast<size_t>(end - begin) * 6 * 18);
  samples.weight.resize(6 * (end - begin));
  int32_t row = 0;
  for (int64_t k = begin; k < end; ++k) {
    const int32_t face = faces[k];
    for (const FacePoint& point : face_points(face_coordinates(nodes, triangles, face))) {
      const double dS = point.area_vector.norm();
      const Eigen::Vector3d normal = point.area_vector / dS;
      for (int a = 0; a < 6; ++a)
        for (int d = 0; d < 3; ++d)
          entries.emplace_back(row, 3 * triangles(face, a) + d, point.shape[a] * normal[d]);
      samples.weight[row++] = dS;
    }
  }
  samples.sample.resize(row, 3 * nodes.rows());
  samples.sample.setFromTriplets(entries.begin(), entries.end());
  return samples;
}

}  // namespace clatter::recover
