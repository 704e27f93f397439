// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Left sides of equations for the dependent DoFs of rigid elements.
#include <vector>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {

/// t . u_d or t . theta_d of a dependent grid d, its own DoF first: the equation lacks its other
/// terms.
struct DependentRow {
  int base = 0;               // 0: of displacements, 3: of rotations
  Eigen::Vector3d direction;  // t, basic axes
  Equation equation;
};

/// One row for each direction in `dofs` of the grid's displacement system, transformed so that no
/// two have the same first DoF. Rotations of nodes of solids, which have none, are left out.
std::vector<DependentRow> dependent_rows(const Model& model, NodeIndex dependent, DofMask dofs,
                                         Origin origin);

}  // namespace clatter::mesh::deck::nastran
