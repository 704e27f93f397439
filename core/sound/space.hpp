// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What surrounds a body: the fluid, and optionally a rigid ground plane.
//
// Convention of this folder: x(t) = Re( X exp(+i 2 pi f t) ), peak amplitudes; waves that leave the
// body are exp(-i k r) / r.
#include <Eigen/Core>
#include <complex>
#include <numbers>
#include <optional>

namespace clatter::sound {

using Complex = std::complex<double>;

/// A fluid without losses, at rest.
struct Fluid {
  double density;      // rho [kg/m3]
  double sound_speed;  // c [m/s]
  /// rho c [Pa s/m].
  double impedance() const { return density * sound_speed; }
  /// k = 2 pi f / c [1/m].
  double wavenumber(double frequency_hz) const {
    return 2.0 * std::numbers::pi * frequency_hz / sound_speed;
  }
};

/// The plane normal . x = offset; the fluid is where normal . x > offset.
struct Plane {
  Eigen::Vector3d normal;  // unit vector
  double offset;           // [m]
  double height(const Eigen::Vector3d& x) const { return normal.dot(x) - offset; }
  Eigen::Vector3d mirrored(const Eigen::Vector3d& x) const { return x - 2.0 * height(x) * normal; }
};

/// The space outside a body: all of it, or the half above a rigid plane (by an image of the body).
struct Space {
  Fluid fluid;
  std::optional<Plane> ground{};
};

}  // namespace clatter::sound
