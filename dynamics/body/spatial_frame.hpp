// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The frame of a body that moves freely in space, rigid or elastic.
#include <Eigen/Core>
#include <array>

#include "core/rom/inertia_invariants.hpp"
#include "dynamics/body/free_rotation.hpp"
#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

/// Coordinates of a spatial body, in this order: centre of mass (3, of second order, in the
/// engine's axes), turn p (4) and angular momentum L about the centre of mass in the engine's axes
/// (3), both states; then n modes of second order.
///
/// The attitude is A = R(p) A_f(t): R the rotation of the quaternion p / |p|, A_f the rotation that
/// the body would have gone on with without forces and vibration (FreeRotation). A_f starts again
/// after each step, p at (1, 0, 0, 0): local coordinates of the rotation group, as in the methods
/// of Munthe-Kaas (1998). A body on which no moment acts keeps p and L exactly.
inline constexpr int kCentre = 0, kTurn = 3, kMomentum = 7, kSpatial = 10;

/// Rotation of a spatial body at an instant, with the derivatives by its 10 + n coordinates.
struct SpatialState {
  Eigen::Matrix3d A;              // from the body's axes to those of the engine
  Eigen::Vector3d spin;           // angular velocity, in the engine's axes [rad/s]
  Matrix34 turn;                  // the small rotation, in the engine's axes, by a change of p
  Matrix3X spin_by_y, spin_by_v;  // 3 x (10 + n); columns of the centre are zero

  // Of the body's own axes: angular velocity w, inertia J(eta) and
  Eigen::Vector3d w;
  Eigen::Matrix3d J;
  Matrix3X H;               // 3 x n, integral of rho (x + u) x N_a: angular momentum J w + H eta'
  Matrix3X drift;           // 3 x n, dH/d eta_a eta'
  Matrix3X J_w;             // 3 x n, dJ/d eta_a w
  Matrix3X w_by_y, w_by_v;  // 3 x (10 + n)
};

/// Inertia of a spatial body and the rotation that it would have without forces.
///
/// A point at x of the body is at r + A (x + u) with u = N eta, both from the centre of mass r, and
///   L = A (J(eta) w + H(eta) eta'),   w = J^-1 (A^T L - H eta')
/// (Shabana, chapter 5). A rigid body has no modes.
class SpatialFrame {
 public:
  /// @param inertia of a rigid body about the centre of mass [kg m2]. @param rotation of unit
  /// length, at the start. @param spin in the body's axes [rad/s].
  SpatialFrame(const Eigen::Matrix3d& inertia, const Eigen::Vector4d& rotation,
               const Eigen::Vector3d& spin);
  /// An elastic body. @param invariants by its modes, about the centre of mass, with N = 0 in the
  /// mean over the mass (first = 0).
  SpatialFrame(const rom::InertiaInvariants& invariants, const Eigen::Vector4d& rotation,
               const Eigen::Vector3d& spin);

  int modes() const { return modes_; }
  const rom::InertiaInvariants& invariants() const { return invariants_; }
  /// A, spin and w alone; `y`, `v`: 10 + n.
  void rotate(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              SpatialState& state) const;
  /// The derivatives, after rotate().
  void differentiate(const Eigen::VectorXd& y, SpatialState& state) const;
  /// p' at the state of a stage (4), and its derivatives by p and by the spin.
  Eigen::Vector4d turn_rate(double time, const Eigen::VectorXd& y, const Eigen::Vector3d& spin,
                            Eigen::Matrix4d* by_p, Matrix43* by_spin) const;
  /// Integral of rho N_k,a (x + u)_l at [3 k + l], n each.
  void arms(const Eigen::VectorXd& eta, std::array<Eigen::VectorXd, 9>& g) const;

  /// The quaternion from the body's axes to those of the engine; `p` of that time.
  Eigen::Vector4d quaternion(double time, const Eigen::Vector4d& p) const;
  /// Angular velocity in the engine's axes by p and its rate.
  Eigen::Vector3d spin(double time, const Eigen::Vector4d& p, const Eigen::Vector4d& rate) const;
  /// p and p' at `time` of a body with this attitude and spin.
  void localise(double time, const Eigen::Vector4d& quaternion, const Eigen::Vector3d& spin,
                Eigen::Vector4d& p, Eigen::Vector4d& rate) const;
  /// The free rotation goes on from here.
  void restart(double time, const Eigen::Vector4d& quaternion, const Eigen::Vector3d& spin) {
    free_.restart(time, quaternion, spin);
  }
  const FreeRotation& free() const { return free_; }
  /// The change of the modes' rates, n, by an impulsive moment about the centre of mass in the
  /// engine's axes [N m s] and impulses on the modes, n. The momenta L and eta' + H^T w take the
  /// impulses; w and eta' follow from the mass matrix of both, (J, H; H^T, 1).
  Eigen::VectorXd rate_jump(double time, const Eigen::VectorXd& y, const Eigen::Vector3d& moment,
                            const Eigen::VectorXd& impulse) const;
  /// J(eta) about the centre of mass [kg m2].
  Eigen::Matrix3d inertia(const Eigen::VectorXd& eta) const;
  /// A^T L = J w + H eta' in the body's axes [N m s].
  Eigen::Vector3d momentum(const Eigen::VectorXd& eta, const Eigen::VectorXd& rate,
                           const Eigen::Vector3d& w) const;

 private:
  int modes_ = 0;
  rom::InertiaInvariants invariants_;
  Eigen::Matrix3d rigid_;  // J without deformation
  FreeRotation free_;
};

}  // namespace clatter::dynamics
