// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Matrices between DoFs of nodes and points beside the cells.
#include <Eigen/Core>
#include <vector>

#include "assembly/coupling/dof_numbers.hpp"
#include "assembly/recipe/recipe.hpp"

namespace clatter::assembly {

/// A row of a [[matrix]]: its DoF.
struct MatrixRow {
  int32_t id = 0;
  int direction = 0;                                   // 0 ... 5: x y z rx ry rz
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
};

std::vector<MatrixRow> rows_of(const MatrixSpec& spec, const mesh::Mesh& mesh,
                               const DofNumbers& numbers);

/// R^T M R of the mass matrices for the unit rigid motions of nodes and points [kg, kg m, kg m2].
/// @param nodal_rigid n_dofs x 6.
Eigen::Matrix<double, 6, 6> rigid_mass_of(const Recipe& recipe, const mesh::Mesh& mesh,
                                          const DofNumbers& numbers,
                                          const Eigen::MatrixXd& nodal_rigid);

}  // namespace clatter::assembly
