// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The boundary element equations of a surface at one frequency, factored once for any number of
// motions and of receivers.
#include <Eigen/Core>

#include "core/sound/complex_lu.hpp"
#include "core/sound/radiation.hpp"

namespace clatter::sound {

class BoundaryEquations {
 public:
  /// Integrates and factors the matrices; `surface` must outlive the object.
  /// @throws InputError for a frequency that is not positive, a surface that is not above the
  /// ground plane
  /// @throws NumericsError when the matrix is singular, or memory is short
  BoundaryEquations(const Surface& surface, const Space& space, double frequency_hz);

  /// Pressures on the surface of a body that moves with these normal velocities, as radiate().
  SurfaceState radiate(const Eigen::MatrixXcd& velocity) const;

  /// The adjoint: L^T p of the pressures p that node flows q (node_flow()) cause is X^T q. One
  /// column for each receiver; node_means() of what is exact for each velocity at corners.
  /// @param of_pressure L, n_v x m
  /// @return X, n_v x m [Pa s/m3 times the unit of L]
  Eigen::MatrixXcd adjoint_flow(Eigen::MatrixXcd of_pressure) const;

  double frequency_hz() const { return frequency_hz_; }
  double condition() const { return lu_.condition(); }

 private:
  const Surface& surface_;
  double frequency_hz_;
  Complex slope_;                  // dp/dn = slope v_n
  Eigen::MatrixXcd B_transposed_;  // 3 n_f x n_v
  ComplexLu lu_;
};

/// Values at nodes of functions that are linear on each face, from their integrals int N_b g dS at
/// the corners: means of the faces around a node by area.
/// @param integrals 3 n_f x m
/// @return n_v x m
Eigen::MatrixXcd node_means(const Surface& surface, const Eigen::MatrixXcd& integrals);

}  // namespace clatter::sound
