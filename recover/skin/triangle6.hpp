// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The quadratic triangle: shape functions, quadrature, and area element.
//
//   v                     nodes: corners 0, 1, 2, then mid-side nodes 01, 12, 20
//   2                     (Gmsh order, which is also VTK's)
//   | \                   corners at (u, v) = (0,0), (1,0), (0,1)
//   5   4
//   |     \               .
//   0--3---1  u
#include <Eigen/Core>
#include <array>

#include "core/base/matrix.hpp"

namespace clatter::recover {

using Shape6 = Eigen::Matrix<double, 6, 1>;
using Coordinates6 = Eigen::Matrix<double, 6, 3>;

/// Values of the six shape functions at (u, v); they sum to one.
Shape6 shape_functions(double u, double v);

/// Their derivatives; column 0 by u, column 1 by v.
Eigen::Matrix<double, 6, 2> shape_gradients(double u, double v);

struct QuadraturePoint {
  double u, v, weight;  // weights sum to 1/2, the area of the reference triangle
};

/// The six-point rule of degree four (Cowper 1973): exact for the square of a quadratic field on a
/// flat triangle.
const std::array<QuadraturePoint, 6>& quadrature_points();

/// A quadrature point of a face: its shape functions and the vector n dS.
struct FacePoint {
  Shape6 shape;
  Eigen::Vector3d area_vector;  // quadrature weight times (x_u cross x_v) [m2]
};

/// The face's quadrature points; `nodes` holds its node coordinates, 6 x 3 [m].
std::array<FacePoint, 6> face_points(const Coordinates6& nodes);

/// Node coordinates of one face, 6 x 3.
Coordinates6 face_coordinates(const RowMatrix& nodes, const IndexMatrix& triangles, int64_t face);

}  // namespace clatter::recover
