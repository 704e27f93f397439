// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// det J of hexahedra, wedges and pyramids in Bernstein form on a cube.
//
// Each reference cell is the image of the cube [0, 1]^3: a hexahedron directly, a wedge with its
// triangle collapsed from a square, a pyramid shrunk toward its apex (a, b) -> (xi, eta) = (a, b)
// (1 - zeta). Pulled back, det J is a polynomial in each coordinate (the rational functions of the
// pyramid become polynomials), so its Bernstein coefficients bound it from both sides; those at the
// corners are function values. See validity.hpp for the use of the bound.
// Source: Johnen, Remacle, Geuzaine, J. Comput. Phys. 233 (2013); Johnen and Geuzaine,
// "Geometrical validity of curvilinear pyramidal finite elements", J. Comput. Phys. 299 (2015).
#include <Eigen/Core>
#include <array>

#include "core/mesh/cell.hpp"

namespace clatter::mesh {

/// Points of the largest degree, 5 x 5 x 5.
inline constexpr int kMostCubePoints = 216;
using CubeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostCubePoints, 1>;

/// Coefficients of one polynomial of degree n[0] x n[1] x n[2], last index fastest.
struct CubePolynomial {
  std::array<int, 3> degree;
  CubeValues coefficients;

  int index(int i, int j, int k) const { return (i * (degree[1] + 1) + j) * (degree[2] + 1) + k; }
  /// Smallest of the eight values at the corners.
  double smallest_corner() const;
  /// The polynomial on one half of the cube, split along `axis`; `upper` or lower half.
  CubePolynomial half(int axis, bool upper) const;
  /// The axis along which neighbouring coefficients differ most.
  int steepest_axis() const;
};

/// det J of a cell with node coordinates `x` (n x 3, order of cell.hpp); not for tetrahedra.
CubePolynomial jacobian_polynomial(CellType type, const Eigen::Ref<const Eigen::MatrixXd>& x);

/// The reference-cell point that corresponds to a point of the cube.
Eigen::Vector3d from_cube(CellType type, const Eigen::Vector3d& at);

}  // namespace clatter::mesh
