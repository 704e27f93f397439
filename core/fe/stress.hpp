// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Stresses from displacements: sigma = C (eps - alpha dT).
//
// In a cell they are evaluated at the optimal points and extrapolated by the linear shape functions
// of its corners (cell_points.hpp); mid-side nodes get the mean of their edge's corners. Nodal
// stress is averaged over the cells of one region only, since stress may jump between materials.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/fe/cell_points.hpp"
#include "core/fe/fe_cells.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::fe {

/// Rows xx yy zz xy yz zx [Pa] in the global frame.
using StressRows = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Nodal stresses of one region, or of one side of its shells.
struct RegionStress {
  std::string name;
  std::vector<int32_t> nodes;  // of the region, ascending
  StressRows stress;           // one row per node
  Eigen::VectorXd von_mises;   // of the averaged stress [Pa]
};

/// sqrt(((s_xx - s_yy)^2 + (s_yy - s_zz)^2 + (s_zz - s_xx)^2) / 2 + 3 (s_xy^2 + s_yz^2 + s_zx^2)).
double von_mises(const Voigt& stress);

/// Stresses at points of one cell: nodes `x` (n x 3 [m]), displacements `u` (3n) [m], temperature
/// rise `dT` (n) [K] or empty. For a hex8 the strain of its incompatible modes is included.
/// InputError for an inverted cell.
StressRows point_stress(mesh::CellType type, const CellPoints& points, const mesh::CellNodes& x,
                        const Material& material, const Eigen::VectorXd& u,
                        const Eigen::VectorXd& dT);

/// Nodal stresses, one entry per region with solids. `nodes` n x 3 [m], `u` 3 n, `dT` n or empty.
std::vector<RegionStress> nodal_stress(const RowMatrix& nodes, const FeCells& cells,
                                       const Eigen::VectorXd& u, const Eigen::VectorXd& dT);

}  // namespace clatter::fe
