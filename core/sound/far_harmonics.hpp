// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The far field of any motion of a surface, as a matrix over the volume flow of its nodes.
//
//   const BoundaryEquations equations(body, air, 500.0);
//   const FarHarmonics far = far_harmonics(body, air, equations);
//   F(e) = sum_lm Y_lm(e) F_lm,   F_lm = of_flow q,   P = 1/2 q^H (of_flow^H of_flow) q / (rho c)
//
// so that parts of the surface, whose flows add up to q, have a power each and between each other.
#include <Eigen/Core>

#include "core/sound/boundary_equations.hpp"

namespace clatter::sound {

/// The far field about `centre` in spherical harmonics.
struct FarHarmonics {
  int degree = 0;
  Eigen::Vector3d centre{0, 0, 0};  // [m]
  /// (degree + 1)^2 x n_v [Pa s/m2]: row l^2 + l + m is the coefficient of Y_lm of F
  /// (spherical_harmonics()), column n belongs to the flow of node n.
  Eigen::MatrixXcd of_flow{};
};

/// The volume flow int N_n v_n dS at each node [m3/s] of motions, N_n linear on each face.
/// @param velocity 3 n_f x m [m/s], as in SurfaceState
/// @return n_v x m
Eigen::MatrixXcd node_flow(const Surface& surface, const Eigen::MatrixXcd& velocity);

/// Computes the matrix by the adjoint equations: row by row it is the pressure on the rigid surface
/// under incident spherical waves, by reciprocity. Within a face that pressure is taken to be
/// linear, and continuous between faces, so that flows at nodes suffice: an error of second order.
FarHarmonics far_harmonics(const Surface& surface, const Space& space,
                           const BoundaryEquations& equations);

/// Twice the power of a far field over the integral of |F|^2 over all directions: 1/(rho c), half
/// of it above a ground plane [m/(Pa s)].
double power_of_far_field(const Space& space);

}  // namespace clatter::sound
