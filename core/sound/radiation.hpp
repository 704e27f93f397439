// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sound of a vibrating surface at one frequency.
//
//   const sound::Surface sphere = sound::closed_surface(nodes, triangles);
//   const sound::Space air{{1.204, 343.2}};
//   const auto state = sound::radiate(sphere, air, 500.0, sound::at_corners(normal_velocity));
//   const Eigen::VectorXd watts = sound::surface_power(sphere, state);
#include <Eigen/Core>

#include "core/sound/space.hpp"
#include "core/sound/surface.hpp"

namespace clatter::sound {

/// What a surface does at one frequency, for m motions: peak amplitudes.
struct SurfaceState {
  double frequency_hz = 0.0;
  Eigen::MatrixXcd velocity{};  // 3 n_f x m [m/s], along the normal, at the corners of each face
  Eigen::MatrixXcd pressure{};  // n_v x m [Pa], linear between nodes
  double condition = 0.0;       // estimate of the condition number of the solved matrix
};

/// Normal velocities that are constant on each face, n_f x m, at the corners: 3 n_f x m.
Eigen::MatrixXcd at_corners(const Eigen::MatrixXcd& face_velocity);

/// Pressures on the surface of a body that moves with these normal velocities; one factorisation
/// for all motions.
/// @param velocity 3 n_f x m [m/s], row 3 f + a: corner a of face f; linear on each face
/// @throws InputError for a frequency that is not positive, a velocity that is not finite or of
/// another size, a surface that is not above the ground plane
/// @throws NumericsError when the matrix is singular, or memory is short
SurfaceState radiate(const Surface& surface, const Space& space, double frequency_hz,
                     const Eigen::MatrixXcd& velocity);

/// Mean pressure on each face, n_f x m [Pa].
Eigen::MatrixXcd face_pressure(const Surface& surface, const SurfaceState& state);

/// P = 1/2 Re int p conj(v_n) dS of each motion, m [W].
Eigen::VectorXd surface_power(const Surface& surface, const SurfaceState& state);

/// Power of each motion over that of pistons in an infinite wall: sigma = P / (1/2 rho c int
/// |v_n|^2 dS), m.
Eigen::VectorXd radiation_efficiency(const Surface& surface, const Fluid& fluid,
                                     const SurfaceState& state, const Eigen::VectorXd& power);

/// R of P = 1/2 q^H R q for a velocity V q, where V holds the real motions of `state`: the
/// symmetric part of int v_n^T Re p dS from the pressures on the surface, m x m [N s/m].
Eigen::MatrixXd surface_resistance(const Surface& surface, const SurfaceState& state);

}  // namespace clatter::sound
