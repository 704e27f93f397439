// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Functions on the sphere.
#include <Eigen/Core>

#include "core/base/matrix.hpp"

namespace clatter::sound {

/// The number of spherical harmonics up to a degree, (degree + 1)^2.
constexpr Eigen::Index harmonic_count(int degree) {
  return static_cast<Eigen::Index>(degree + 1) * (degree + 1);
}

/// Real spherical harmonics, orthonormal over the sphere, without the phase of Condon and Shortley:
///
///   Y_lm = sqrt(2) P_l|m|(z) cos(m phi) for m > 0, sin(|m| phi) for m < 0, P_l0(z) for m = 0
///
/// P normalised, by their stable recurrence in l (Holmes and Featherstone 2002). Y_00 = 1 / sqrt(4
/// pi).
/// @param unit n_d x 3, unit vectors
/// @return n_d x harmonic_count(degree), column l^2 + l + m
Eigen::MatrixXd spherical_harmonics(const RowMatrix& unit, int degree);

}  // namespace clatter::sound
