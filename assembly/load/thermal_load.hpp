// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nodal forces of thermal strains.
#include <Eigen/Core>
#include <vector>

#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Forces of the temperature rise `dT` (one value per node) [K] with all displacements held:
/// f = sum over cells of int B^T C alpha dT dV [N], 3 n_nodes. K u = f gives the free expansion.
Eigen::VectorXd thermal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                             const Eigen::VectorXd& dT);

}  // namespace clatter::assembly
