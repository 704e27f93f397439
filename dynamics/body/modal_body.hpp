// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A body as a set of decoupled oscillators: eta'' + delta eta' + omega^2 eta = phi^T f.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::dynamics {

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
