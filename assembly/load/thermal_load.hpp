// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nodal forces of thermal strains.
#include <Eigen/Core>
#include <vector>

#include "assembly/constraint/part_data.hpp"
#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Forces on solids of the temperature rise `dT` (one value per node) [K] with all displacements
/// held: f = sum over cells of int B^T C alpha dT dV [N], 3 n_nodes. K u = f gives the free
/// expansion.
Eigen::VectorXd thermal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                             const Eigen::VectorXd& dT);

/// The same of the shells, with moments: int B^T A alpha dT dA of each (shell_thermal_force), in
/// the ids of all DoFs. Their materials expand the same in all directions.
Eigen::VectorXd shell_thermal_load(const PartData& part, const Eigen::VectorXd& dT);

}  // namespace clatter::assembly
