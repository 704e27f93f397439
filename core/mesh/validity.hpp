// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rigorous check that cells are not folded.
//
// det J is a polynomial, and its Bezier coefficients bound it (cube_bernstein.hpp: cells other than
// tetrahedra). The map x(lambda) of a tet10 is quadratic, so det J is a cubic polynomial. In Bezier
// form, det J = sum_b c_b B_b(lambda), the 20 coefficients c_b bound it from below and the four at
// the corners are values: if all are positive, det J > 0 everywhere; if one corner is <= 0, the
// cell is invalid. Otherwise the cell is bisected and the coefficients of the parts are checked.
// Values at points (Gauss points or nodes) prove nothing: hard case G2. Source: Johnen, Remacle,
// Geuzaine, "Geometrical validity of curvilinear finite elements", J. Comput. Phys. 233 (2013),
// section 2 and 3.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Coordinates of a cell's nodes, one row per node, Gmsh order [m].
using Tet10Nodes = Eigen::Matrix<double, 10, 3>;

/// Coordinates of any cell's nodes.
using CellNodes = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMaxCellNodes, 3>;

/// Bounds of det J over one cell [m3].
struct JacobianBounds {
  double min = 0.0;   // proved lower bound; positive means valid everywhere
  double mean = 0.0;  // volume of the cell over that of the reference cell
  /// Scaled Jacobian: 1 for a straight tetrahedron, box, prism or pyramid, <= 0 for a folded cell.
  double ratio() const { return mean > 0.0 ? min / mean : -1.0; }
};

/// Bounds of det J of a quadratic tetrahedron by Bezier coefficients.
JacobianBounds jacobian_bounds(const Tet10Nodes& x);
/// The same for any cell.
JacobianBounds jacobian_bounds(CellType type, const CellNodes& x);

/// Volume of a quadratic tetrahedron [m3]: mean of the Bezier coefficients / 6, exact.
double volume_of(const Tet10Nodes& x);
/// Volume of any cell [m3], exact.
double volume_of(CellType type, const CellNodes& x);

/// The nodes of one cell.
CellNodes cell_nodes(const Mesh& mesh, const CellBlock& block, Eigen::Index cell);
/// The nodes of a tetrahedron; a tet4 gets mid-side nodes.
Tet10Nodes tet_nodes(const Mesh& mesh, const CellBlock& block, Eigen::Index cell);

/// Cell number for messages: that of the imported file, else its row.
int32_t cell_label(const CellBlock& block, Eigen::Index cell);

struct InvalidCell {
  int32_t block;
  int32_t cell;            // row in the block
  int32_t label;           // cell_label()
  Eigen::Vector3d centre;  // mean of the corners [m]
  double ratio;            // min det J / mean det J
};

struct ValidityReport {
  std::vector<InvalidCell> invalid;  // worst first
  double min_ratio = 1.0;            // over all cells
};

/// Checks every cell.
ValidityReport check_validity(const Mesh& mesh);

/// "cell 12 of block 0 at (0.01, 0.2, 0.3) m: min det J / mean = -0.2", for the first `count`.
std::string describe_invalid(const ValidityReport& report, size_t count);

}  // namespace clatter::mesh
