// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Coefficients with which a step moves a free oscillator exactly.

namespace clatter::dynamics {

/// A two-stage method multiplies the state x' = A x by R(dt A) in a step, where exp(dt A) is exact.
/// With alpha I + beta A in place of A, where R(dt (alpha + beta lambda)) = exp(dt lambda) for both
/// eigenvalues, a free motion is exact at any step, and so is that under a constant force, when the
/// deviation from its equilibrium takes the place of x. alpha and beta - 1 fall with dt^2, so the
/// method's order is kept. The idea is that of exponential fitting (Liniger and Willoughby 1970),
/// here mode by mode.
struct ExactMode {
  double alpha = 0.0;  // [1/s]
  double beta = 1.0;
};

/// Of an oscillator with omega^2 and damping delta (eta'' + delta eta' + omega^2 eta = f), for
/// R(z) = (1 + (1 - 2 d) z) / (1 - d z)^2. Neither rigid nor overdamped modes are changed, nor
/// those that turn by more than kMostTurn in a step: they keep the damping of the method.
ExactMode exact_mode(double omega_squared, double delta, double dt, double d);
inline constexpr double kMostTurn = 2.5;  // [rad]

}  // namespace clatter::dynamics
