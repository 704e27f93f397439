// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inertia of a reduced body whose frame accelerates and rotates: eq. (9) of the paper.
#include <Eigen/Core>
#include <array>

#include "core/base/h5_file.hpp"

namespace clatter::rom {

/// Motion of the body's frame, in the axes of that frame.
struct FrameMotion {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // of its origin, absolute [m/s2]
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();         // Omega [rad/s]
  Eigen::Vector3d omega_rate = Eigen::Vector3d::Zero();    // [rad/s2]
};

/// Inertia shape integrals (Shabana, Dynamics of Multibody Systems, section 5.3) of a body with the
/// displacement field u = N(x) q in its frame, N_k its row in direction k:
///   first   [k]        integral of rho N_k          r
///   moment  [3 l + k]  integral of rho x_l N_k      r
///   product [3 k + l]  integral of rho N_k^T N_l    r x r, product[3 l + k] its transpose
///   place              integral of rho x x^T        3 x 3 [kg m2]
/// A particle's acceleration is a + (A' + A^2)(x + u) + 2 A u' + u'' with A = Omega x, A' = Omega'
/// x, so with B = A' + A^2 the terms p* of eq. (8), (9) in reduced coordinates are
///   p* = -[ sum_k a_k first_k + sum_kl B_kl (moment_lk + product_kl q) + 2 sum_kl A_kl product_kl
///   q' ].
struct InertiaInvariants {
  std::array<Eigen::VectorXd, 3> first;
  std::array<Eigen::VectorXd, 9> moment;
  std::array<Eigen::MatrixXd, 9> product;
  Eigen::Matrix3d place = Eigen::Matrix3d::Zero();

  bool empty() const { return first[0].size() == 0; }
  Eigen::Index size() const { return first[0].size(); }

  /// p* at rest in the frame (q = q' = 0): translation, Euler and centrifugal loads, r.
  Eigen::VectorXd load(const FrameMotion& motion) const;
  /// G of -G q', r x r, skew: 2 sum A_kl product_kl (Coriolis).
  Eigen::MatrixXd gyroscopic(const Eigen::Vector3d& omega) const;
  /// C of -C q, r x r: sum B_kl product_kl (centrifugal softening, symmetric, and Euler, skew).
  Eigen::MatrixXd softening(const FrameMotion& motion) const;
  /// p* = load - softening q - gyroscopic q'.
  Eigen::VectorXd force(const FrameMotion& motion, const Eigen::VectorXd& q,
                        const Eigen::VectorXd& v) const;
  /// The same invariants in coordinates z, q = W z; W is r x p.
  InertiaInvariants in(const Eigen::MatrixXd& W) const;
};

/// Group `inertia_invariants`: first (3 x r), moment (9 x r), place, product_xx, _yy, _zz, _xy,
/// _yz, _zx. Nothing is written when empty.
void write_inertia_invariants(H5File& file, const InertiaInvariants& invariants);
/// Empty when the file has none. InputError when shapes are wrong, a value is not finite, or
/// product_xx + product_yy + product_zz differs from M_rr by more than 1e-9 of its largest entry.
InertiaInvariants read_inertia_invariants(const H5File& file, const Eigen::MatrixXd& M_rr);

}  // namespace clatter::rom
