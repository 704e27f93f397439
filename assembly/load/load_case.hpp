// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Consistent nodal forces of unit load cases, on nodal displacements (3 n_nodes).
#include <Eigen/Core>

#include "assembly/surface/surface_integral.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// Nodal forces of a pressure of 1 Pa on a surface: f_a = - int N_a n dA [N/Pa].
Eigen::VectorXd pressure_load(Eigen::Index n_nodes, const SurfaceIntegrals& surface);

/// A resultant `force` [N] spread evenly over a surface: f_a = force w_a / A. It acts at the
/// centroid: no moment about it.
Eigen::VectorXd resultant_load(Eigen::Index n_nodes, const SurfaceIntegrals& surface,
                               const Eigen::Vector3d& force);

/// A resultant `force` [N] spread around the point `at` [m] of a surface: traction in proportion to
/// (1 - r^2 / radius^2)^2 at the distance r < radius of it. So it acts at this point, wherever
/// nodes are; where it does not, as at an edge of the surface, a warning says so. InputError,
/// beginning with `where`, when no part of the surface is so near.
Eigen::VectorXd resultant_load(const RowMatrix& nodes, const mesh::Surface& surface,
                               const Eigen::Vector3d& force, const Eigen::Vector3d& at,
                               double radius, const std::string& where);

/// A force [N] and moment [N m] on a set, in the model's coordinates (size n). The force is shared
/// evenly by the nodes of the set. InputError, beginning with `where`, when the set has no
/// coordinate along a component of it. On a bolt the force's component along it is the tension.
Eigen::VectorXd set_load(Eigen::Index n, const rom::DofSet& set, const Eigen::Vector3d& force,
                         const Eigen::Vector3d& moment, const std::string& where);

}  // namespace clatter::assembly
