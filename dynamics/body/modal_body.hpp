// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A body as a set of decoupled oscillators: eta'' + delta eta' + omega^2 eta = phi^T f.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"

namespace clatter::dynamics {

class SpatialFrame;

/// Forces (x, y, z) [N] and moments [N m] about an origin.
using Wrench = Eigen::Matrix<double, 6, 1>;

/// A unit force along axis k < 3 at `point` [m], or a unit moment about axis k - 3.
Wrench unit_wrench(int k, const Eigen::Vector3d& point);
/// The same forces with their moments about another origin, from which the first one is at `point`.
Wrench moved(const Wrench& wrench, const Eigen::Vector3d& point);

/// What the error of a first-order coordinate is measured by.
enum class StateError : char {
  kNone,      // not a state: a coordinate of second order
  kOwn,       // tolerance times `state_scale`
  kRotation,  // an angle [rad] times `state_scale`: by the displacement scale over the arm
  kSpin,      // an angular velocity [rad/s] times `state_scale`: by the velocity scale over the arm
};

/// A body as coordinates that are coupled by forces only. In its own eigenbasis, for a linear
/// elastic body, q = shapes eta with shapes^T M_rr shapes = I.
///
/// Modes beyond `mode_limit_hz` may drop their inertia (inertia = 0): they follow their load
/// quasi-statically, omega^2 eta + delta eta' = phi^T f. A state, a coordinate of first order, is
/// the same with omega = 0: delta z' = f.
struct ModalBody {
  std::string name;
  Eigen::MatrixXd shapes;         // r x n_m, mass-normalised
  Eigen::MatrixXd combined;       // c x n_m, of the model's combined DoFs
  Eigen::VectorXd omega_squared;  // n_m [1/s2], ascending; exactly 0 for rigid modes
  Eigen::VectorXd damping;        // n_m [1/s], alpha omega^2 + beta + 2 zeta omega; rigid: 0
  Eigen::VectorXd inertia;        // n_m, 1 or 0
  Eigen::MatrixXd rigid;          // n_m x 6, M-weighted: shapes^T M_rr r of the unit rigid motions,
                                  // or shapes^T inertia_force of a part with supports
  std::vector<int32_t> is_rotation;  // r + c, 1 where the DoF is a rotation
  int rigid_modes = 0;               // the first ones
  double mass = 0.0;                 // [kg]

  std::vector<StateError> state_error;  // n_m; empty: no coordinate is a state
  Eigen::VectorXd state_scale;          // n_m, > 0 for states
  std::shared_ptr<SpatialFrame> frame;  // of a spatial body: one system's, not to be shared
  Eigen::VectorXd eta_start, v_start;   // n_m, the state at the start; empty: zero
  /// Scales of the error test for this body; 0: those of the run (Accuracy).
  double displacement_scale = 0.0, velocity_scale = 0.0;  // [m], [m/s]
  double arm = 0.0;    // by which rotations become displacements there [m]
  std::string family;  // of bodies that messages name together: the links of a chain

  int modes() const { return static_cast<int>(omega_squared.size()); }
  int size() const { return static_cast<int>(shapes.rows()); }
  bool is_state(int mode) const {
    return !state_error.empty() && state_error[mode] != StateError::kNone;
  }
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
