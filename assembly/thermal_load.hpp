#pragma once
// Nodal forces of thermal strains.
#include <Eigen/Core>
#include <vector>

#include "core/fe/material.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// Forces that the temperature rise `dT` (one a node) [K] causes when all displacements are held:
/// f = sum over cells of int B^T C alpha dT dV [N], 3 n_nodes. K u = f frees the part.
Eigen::VectorXd thermal_load(const mesh::Mesh& mesh, const std::vector<fe::Material>& materials,
                             const Eigen::VectorXd& dT);

}  // namespace clatter::assembly
