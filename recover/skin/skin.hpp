// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Geometry of a skin of quadratic triangles: areas, normals, weights, and the sparse operators that
// take nodal velocity vectors to normal velocities.
#include <Eigen/SparseCore>
#include <vector>

#include "core/base/matrix.hpp"

namespace clatter::recover {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t>;

/// Geometric quantities of a skin. Normals point out of the solid.
struct SkinGeometry {
  Eigen::VectorXd face_area;  // n_f [m2], integral of dS
  RowMatrix face_normal;      // n_f x 3, unit vector along the integral of n dS
  RowMatrix face_centre;      // n_f x 3 [m], area-weighted
  RowMatrix node_normal;      // n_s x 3, unit: mean of the adjoining faces' normals there, by area
  Eigen::VectorXd node_area;  // n_s [m2], positive shares that sum to the area
  double area = 0.0;          // [m2]
  double volume = 0.0;   // [m3], 1/3 integral of x . n dS; of the solid when the skin is closed
  double closure = 0.0;  // |integral of n dS| / area: 0 for a closed skin
};

/// Measures areas, normals and weights.
///
/// The share of node a in face f is proportional to the integral of N_a^2 (HRZ lumping: Hinton,
/// Rock, Zienkiewicz 1976), because the integral of N_a itself vanishes at the corners.
/// @param nodes n_s x 3 [m]
/// @param triangles n_f x 6, outward orientation
/// @throws InputError for a face without area, or a closed skin that is inside out
SkinGeometry measure_skin(const RowMatrix& nodes, const IndexMatrix& triangles);

/// Mean normal velocity per face: v_n,f = (1/A_f) sum_a (integral of N_a n dS) . v_a.
/// @return n_f x 3 n_s; column 3 a + d belongs to node a, direction d
SparseRows face_normal_operator(const RowMatrix& nodes, const IndexMatrix& triangles,
                                const SkinGeometry& geometry);

/// Normal velocity at the quadrature points of some faces, with the areas of these points.
struct NormalSamples {
  SparseRows sample;       // 6 n x 3 n_s: row g takes nodal velocities to v_n at point g
  Eigen::VectorXd weight;  // 6 n [m2]: sum_g weight_g v_n,g^2 = integral of v_n^2 dS
};

/// Samples for faces[begin .. end).
NormalSamples normal_samples(const RowMatrix& nodes, const IndexMatrix& triangles,
                             const std::vector<int32_t>& faces, int64_t begin, int64_t end);

}  // namespace clatter::recover
