// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Directivity, and the power that leaves through a distant sphere.
#include <Eigen/Core>

#include "core/sound/radiation.hpp"

namespace clatter::sound {

/// Directions with weights that integrate over the unit sphere.
struct Directions {
  RowMatrix unit;          // n_d x 3
  Eigen::VectorXd weight;  // n_d, sums to 4 pi [sr]
};

/// Gauss points over the height, equally spaced ones around: exact for spherical harmonics up to
/// degree 2 `degree` + 1; (degree + 1)(2 degree + 2) directions.
Directions sphere_directions(int degree);

/// The directions that resolve the power of any motion of the surface: |F|^2 contains spherical
/// harmonics up to about 2 k radius (Wiscombe 1980 has the margin).
Directions power_directions(const Surface& surface, const Space& space, double frequency_hz);

/// The degree of those directions.
int power_degree(const Surface& surface, const Space& space, double frequency_hz);

/// The functionals of far_field(): F = of_pressure^T p + of_velocity^T v, column d of each belongs
/// to direction d.
struct FarRows {
  Eigen::MatrixXcd of_pressure;  // n_v x n_d [m]
  Eigen::MatrixXcd of_velocity;  // 3 n_f x n_d [Pa s]
};
FarRows far_rows(const Surface& surface, const Space& space, double frequency_hz,
                 const RowMatrix& unit);

/// F of p = F exp(-i k r) / r far from the origin, in each direction [Pa m]:
///
///   F(e) = 1/(4 pi) int ( i k e . n p + i omega rho v_n ) exp(i k e . y) dS
///
/// @param unit n_d x 3; with a ground plane only directions away from it have a meaning
/// @return n_d x m
Eigen::MatrixXcd far_field(const Surface& surface, const Space& space, const SurfaceState& state,
                           const RowMatrix& unit);

/// P = 1/(2 rho c) int |F|^2 over the sphere, half of it above a ground plane: m [W], not negative.
/// Unlike the power from the pressures on the surface it remains exact where little is radiated:
/// errors of the reactive pressure hardly reach the far field.
Eigen::VectorXd far_power(const Surface& surface, const Space& space, const SurfaceState& state);

/// R of P = 1/2 q^T R q as in surface_resistance(), from the far field: Re int conj(F) F / (rho c).
/// Positive semidefinite, m x m [N s/m].
Eigen::MatrixXd far_resistance(const Surface& surface, const Space& space,
                               const SurfaceState& state);

}  // namespace clatter::sound
