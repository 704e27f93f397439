// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cell quality, and positions of the worst cells.
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh {

/// One of the worst cells by some measure.
struct WorstCell {
  double value = 0.0;
  int32_t block = 0, cell = 0;  // block and row
  int32_t label = 0;            // its cell_label()
  Eigen::Vector3d position;     // its centre [m]
};
inline constexpr size_t kWorstCells = 10;

/// One measure over all cells.
struct Measure {
  double worst = 0.0;
  int32_t block = 0, cell = 0;                                // the worst cell: block and row
  int32_t label = 0;                                          // its cell_label()
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         // its centre [m]
  double low = 0.0, high = 1.0;                               // range of the histogram
  std::vector<int64_t> histogram = std::vector<int64_t>(20);  // equal bins from low to high
  std::map<CellType, std::vector<int64_t>> by_type;           // the same of each cell type
  std::vector<WorstCell> worst_cells;                         // kWorstCells at most, worst first
};

/// Angles and shapes are those of the straight cell through the corners (hard case G8), the scaled
/// Jacobian that of the curved one.
struct QualityReport {
  Measure min_dihedral_deg;  // smallest angle between faces; 70.53 for a regular tetrahedron
  Measure max_dihedral_deg;  // largest
  Measure radius_ratio;     // tetrahedra: 3 r_in / r_circum, 1 for a regular cell, 0 for a flat one
  Measure scaled_jacobian;  // min det J / mean det J, proved bound (validity.hpp)
};

QualityReport measure_quality(const Mesh& mesh);

/// Six angles between the faces of a tetrahedron with corners in rows, (4 x 3), edge order of
/// kTetEdges [deg].
Eigen::Matrix<double, 6, 1> dihedral_angles(const Eigen::Matrix<double, 4, 3>& corners);

/// cos(smallest angle) by the faces' normals n_i, cos(angle) = -n_i . n_j / (|n_i| |n_j|): many
/// times faster, accurate to kCosineError. NaN where a face is so flat that its normal loses
/// digits.
double largest_cosine(const Eigen::Matrix<double, 4, 3>& corners);
inline constexpr double kCosineError = 1e-9;

/// The smallest of the six if it is below `limit_deg`, bitwise equal to that of dihedral_angles();
/// else some angle that is not below it. Most cells need no inverse tangent for that.
double smallest_dihedral(const Eigen::Matrix<double, 4, 3>& corners, double limit_deg);

/// Angles between the faces at each edge of any cell, at both ends of the edge, (2 edges) [deg].
std::vector<double> dihedral_angles(CellType type, const CellNodes& x);

/// The smallest of those.
double smallest_angle_of(CellType type, const CellNodes& x);

/// 3 r_in / r_circum.
double radius_ratio(const Eigen::Matrix<double, 4, 3>& corners);

/// Writes group `quality`: per measure the histogram, that of each cell type (by_type/<name>), the
/// worst cell, and the worst cells (worst_cells: labels, worst_values, worst_places).
void write_quality(H5File& file, const QualityReport& report);

}  // namespace clatter::mesh
