// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mass properties from the mass of the rigid motions.
#include <Eigen/Core>

#include "core/rom/reduced_model.hpp"

namespace clatter::rom {

/// Rigid motions with rotations about `point` [m] instead of the origin: column 3 + j of R less the
/// translation e_j x point.
/// @param rigid n x 6: unit translations, then unit rotations about the axes through the origin.
Eigen::MatrixXd rigid_about(const Eigen::MatrixXd& rigid, const Eigen::Vector3d& point);

/// Mass, centre and inertia about it from R^T M R = [m I, -m c x; m c x, J] of rigid motions about
/// `point`, c from there to the centre. Digits are lost in proportion to m |c|^2 / J, so that
/// `point` should lie near the centre (hard cases F2, F3).
/// @param rigid_mass 6 x 6 [kg, kg m, kg m2].
MassProperties properties_of(const Eigen::MatrixXd& rigid_mass,
                             const Eigen::Vector3d& point = Eigen::Vector3d::Zero());

}  // namespace clatter::rom
