#pragma once
// The load of a part that turns at constant speed, seen from the part.
#include <Eigen/Core>
#include <vector>

#include "assembly/recipe.hpp"
#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Nodal forces (3 n_nodes) [N a (rad/s)^2] f_a = int rho N_a r dV, r the arm from the axis:
/// multiplied by omega^2 they are the body force rho omega^2 r, exact on curved cells. `regions`
/// (indices of mesh.regions) are those that turn; none: all.
Eigen::VectorXd centrifugal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                                 const fe::RotationAxis& axis, const std::vector<int32_t>& regions);

/// Force (3) and moment (3) on the place of a point mass [N, N m a (rad/s)^2]: m r of its centre,
/// with the lever of its offset and the moment -n x (J n) that turns its main axes out of line.
Eigen::Matrix<double, 6, 1> centrifugal_force(const PointMassSpec& mass,
                                              const Eigen::Vector3d& place,
                                              const fe::RotationAxis& axis);

}  // namespace clatter::assembly
