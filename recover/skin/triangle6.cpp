// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/triangle6.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace clatter::recover {

Shape6 shape_functions(double u, double v) {
  const double w = 1.0 - u - v;
  Shape6 n;
  n << w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * w * u, 4 * u * v, 4 * v * w;
  return n;
}

Eigen::Matrix<double, 6, 2> shape_gradients(double u, double v) {
  const double w = 1.0 - u - v;
  Eigen::Matrix<double, 6, 2> g;
  g << 1 - 4 * w, 1 - 4 * w,  //
      4 * u - 1, 0,           //
      0, 4 * v - 1,           //
      4 * (w - u), -4 * u,    //
      4 * v, 4 * u,           //
      -4 * v, 4 * (w - v);
  return g;
}

const std::array<QuadraturePoint, 6>& quadrature_points() {
  static const auto points = [] {
    const double s = std::sqrt(10.0);
    const double t = std::sqrt(38.0 - 44.0 * std::sqrt(0.4));
    const double root = std::sqrt(213125.0 - 53320.0 * s);
    const double a = (8 - s + t) / 18, weight_a = (620 + root) / 7440;
    const double b = (8 - s - t) / 18, weight_b = (620 - root) / 7440;
    return std::array<QuadraturePoint, 6>{{{a, a, weight_a},
                                           {1 - 2 * a, a, weight_a},
                                           {a, 1 - 2 * a, weight_a},
                                           {b, b, weight_b},
                                           {1 - 2 * b, b, weight_b},
                                           {b, 1 - 2 * b, weight_b}}};
  }();
  return points;
}

std::array<FacePoint, 6> face_points(const Coordinates6& nodes) {
  std::array<FacePoint, 6> points;
  for (size_t g = 0; g < points.size(); ++g) {
    const QuadraturePoint& rule = quadrature_points()[g];
    const Eigen::Matrix<double, 3, 2> tangents =
        nodes.transpose() * shape_gradients(rule.u, rule.v);
    points[g].shape = shape_functions(rule.u, rule.v);
    points[g].area_vector = rule.weight * tangents.col(0).cross(tangents.col(1));
  }
  return points;
}

Coordinates6 face_coordinates(const RowMatrix& nodes, const IndexMatrix& triangles, int64_t face) {
  Coordinates6 x;
  for (int a = 0; a < 6; ++a) x.row(a) = nodes.row(triangles(face, a));
  return x;
}

}  // namespace clatter::recover
