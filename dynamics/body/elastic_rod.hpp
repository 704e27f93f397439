// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The connecting rod as a reduced elastic body in the moving frame of the ideal slider-crank.
#include <Eigen/Core>

#include "core/rom/reduced_model.hpp"
#include "dynamics/body/modal_body.hpp"
#include "dynamics/body/rigid_rod.hpp"

namespace clatter::dynamics {

/// Coordinates of an elastic rod: deviations y, z of its centre of mass from the ideal rod, in the
/// engine's axes, and of its rotation about x, as those of a rigid rod; then n small motions in the
/// rod's own axes, three rigid ones out of the crank's plane and the elastic modes.
inline constexpr int kRodPlanar = 3, kRodRigid = 6;

/// What the small motions zeta of a rod, u = N zeta in its own axes about its centre of mass,
/// change of its inertia about x and of its angular momentum:
///   J = I + 2 g zeta + zeta^T S zeta,   L = J w + zeta^T G zeta'
struct RodCoupling {
  Eigen::VectorXd stretch;      // g, integral of rho (y N_y + z N_z), n
  Eigen::MatrixXd square;       // S, integral of rho (N_y^T N_y + N_z^T N_z), n x n
  Eigen::MatrixXd circulation;  // G, integral of rho (N_y^T N_z - N_z^T N_y), n x n, skew
  double inertia = 0.0;         // I [kg m2]
};

/// An elastic rod; its own axes: x along the crankshaft, z from the big end to the small end. All
/// coordinates are mass-normalised and have no mass in common.
struct ElasticRod {
  ModalBody body;          // DoFs: y, z, rotation, then those of the reduced model by its n motions
  double inertia = 0.0;    // about x through the centre of mass [kg m2]
  Eigen::Vector3d centre;  // of mass, in the model's frame [m]
  Eigen::MatrixXd shapes;  // r x n: q of the n motions
  RodCoupling coupling;    // of the n motions with the rod's rotation
};

/// @param model with inertia invariants. @param free its modes. InputError when there are no
/// invariants, or when it has not all six rigid motions.
ElasticRod make_elastic_rod(const rom::ReducedModel& model, const ModalBody& free);

/// Mass and shape between two points of the rod's plane. @param big, small: in the model's frame
/// [m].
RodProperties rod_properties(const ElasticRod& rod, const Eigen::Vector3d& big,
                             const Eigen::Vector3d& small);

}  // namespace clatter::dynamics
