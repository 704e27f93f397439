// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Stresses at the two faces of shells: sigma = C (e +- t/2 k) under plane stress, e and k without
// thermal strains, C of the layer there.
//
// Strains of a quadrilateral are evaluated at its 2 x 2 points, those of a tri6 at three, and
// extrapolated to the nodes; those of a tri3 are taken at its centre. At a node they are averaged
// over the cells of one region that share its director; where a sheet is folded or sheets meet, the
// largest by von Mises counts.
#include <vector>

#include "core/fe/fe_cells.hpp"
#include "core/fe/stress.hpp"

namespace clatter::fe {

/// Of each region with shells: "<region> (outer)" on the outward side, then "<region> (inner)".
/// @param u 3 n_nodes [m]. @param turning nodes with rotations, ascending. @param theta 3 each
/// [rad]. @param dT temperature rise (n_nodes) [K], or empty.
std::vector<RegionStress> shell_stress(const RowMatrix& nodes, const FeCells& cells,
                                       const Eigen::VectorXd& u,
                                       const std::vector<int32_t>& turning,
                                       const Eigen::VectorXd& theta, const Eigen::VectorXd& dT);

}  // namespace clatter::fe
