// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Stiffness of isotropic tetrahedra, the most common cells, with sizes fixed at compile time.
#include <Eigen/Core>

#include "core/fe/cell_points.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::fe {

/// K_e (3n x 3n, both triangles) of a tet4 or tet10 at the points of its rule; returns the smallest
/// det J found; where it is not positive, K is incomplete.
double tet_stiffness(mesh::CellType type, const mesh::CellNodes& x, const Material& material,
                     const CellPoints& points, Eigen::MatrixXd& K);

}  // namespace clatter::fe
