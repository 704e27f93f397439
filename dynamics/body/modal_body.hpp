// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A body as a set of decoupled oscillators: eta'' + delta eta' + omega^2 eta = phi^T f.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::dynamics {

/// Forces (x, y, z) [N] and moments [N m] about an origin.
using Wrench = Eigen::Matrix<double, 6, 1>;

/// A unit force along axis k < 3 at `point` [m], or a unit moment about axis k - 3.
Wrench unit_wrench(int k, const Eigen::Vector3d& point);
/// The same forces with their moments about another origin, from which the first one is at `point`.
Wrench moved(const Wrench& wrench, const Eigen::Vector3d& point);

/// A linear body in its own eigenbasis, q = shapes eta with shapes^T M_rr shapes = I.
///
/// Modes beyond `mode_limit_hz` may drop their inertia (inertia = 0): they follow their load
/// quasi-statically, omega^2 eta + delta eta' = phi^T f.
struct ModalBody {
  std::string name;
  Eigen::MatrixXd shapes;         // r x n_m, mass-normalised
  Eigen::MatrixXd combined;       // c x n_m, of the model's combined DoFs
  Eigen::VectorXd omega_squared;  // n_m [1/s2], ascending; exactly 0 for rigid modes
  Eigen::VectorXd damping;        // n_m [1/s], alpha omega^2 + beta + 2 zeta omega; rigid: 0
  Eigen::VectorXd inertia;        // n_m, 1 or 0
  Eigen::MatrixXd rigid;          // n_m x 6, M-weighted: shapes^T M_rr r of the unit rigid motions
  std::vector<int32_t> is_rotation;  // r + c, 1 where the DoF is a rotation
  int rigid_modes = 0;               // the first ones
  double mass = 0.0;                 // [kg]

  int modes() const { return static_cast<int>(omega_squared.size()); }
  int size() const { return static_cast<int>(shapes.rows()); }
  /// The displacement of a DoF (of ReducedModel::places) by the modal coordinates, n_m.
  Eigen::RowVectorXd row_of(int dof) const {
    if (dof >= size()) return combined.row(dof - size());
    return shapes.row(dof);
  }
  /// The modal force (n_m) of least norm with the resultant `wrench` about the body's origin,
  /// R (R^T R)^-1 w, R = rigid: inertia forces of a rigid motion, so that a free body does not
  /// deform. Its transpose is a coordinate: of a unit wrench along k the motion k of the body's
  /// rigid frame, (R^T R)^-1 R^T eta, its mass-weighted mean motion.
  /// NumericsError for bodies without six rigid motions, as one that moves in a plane.
  Eigen::VectorXd force_of(const Wrench& wrench) const;
};

/// Options of make_modal_body().
struct ModalBodyOptions {
  bool elastic = true;         // false: the rigid modes only
  double mode_limit_hz = 0.0;  // inertia of modes above is dropped; 0: never
};

/// Solves K_rr phi = omega^2 M_rr phi once. Rigid modes are identified exactly: the combinations of
/// the six rigid motions with |K_rr r| below 1e-8 |K_rr| |r| are M-orthonormalised, shifted out of
/// the elastic spectrum by K - s M R R^T M, and get omega = 0 and no damping.
/// NumericsError when M_rr is not positive definite, when an elastic eigenvalue is not positive, or
/// when a rigid variant is requested of a held body.
ModalBody make_modal_body(const rom::ReducedModel& model, const ModalBodyOptions& options);

}  // namespace clatter::dynamics
