// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The load of a part that rotates at constant speed, in the rotating frame.
#include <Eigen/Core>
#include <vector>

#include "assembly/recipe/recipe.hpp"
#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Nodal forces (3 n_nodes) [N per (rad/s)^2] f_a = int rho N_a r dV, r the arm from the axis:
/// multiplied by omega^2 they are the body force rho omega^2 r, exact on curved cells. `regions`
/// (indices of mesh.regions) are those that rotate; empty: all.
Eigen::VectorXd centrifugal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                                 const fe::RotationAxis& axis, const std::vector<int32_t>& regions);

/// Force (3) and moment (3) at the position of a point mass [N, N m per (rad/s)^2]: m r of its
/// centre, with the lever arm of its offset, and the gyroscopic moment -n x (J n) of its inertia.
Eigen::Matrix<double, 6, 1> centrifugal_force(const PointMassSpec& mass,
                                              const Eigen::Vector3d& position,
                                              const fe::RotationAxis& axis);

}  // namespace clatter::assembly
