// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/exact_mode.hpp"

#include <cmath>
#include <complex>

namespace clatter::dynamics {

ExactMode exact_mode(double omega_squared, double delta, double dt, double d) {
  const double rate = -0.5 * delta;
  const double turn_squared = omega_squared - rate * rate;
  if (!(turn_squared > 0.0)) return {};
  const double turn = std::sqrt(turn_squared);
  if (dt * turn > kMostTurn) return {};
  using Complex = std::complex<double>;
  // E - 1 without cancellation, E = exp(dt lambda).
  const double half = std::sin(0.5 * dt * turn), growth = std::exp(dt * rate);
  const Complex change(std::expm1(dt * rate) - 2.0 * growth * half * half,
                       growth * std::sin(dt * turn));
  const Complex E = 1.0 + change;
  // d^2 E z^2 - (2 d E + 1 - 2 d) z + (E - 1) = 0; the root that vanishes with E - 1.
  const Complex B = 2.0 * d * E + (1.0 - 2.0 * d);
  const Complex z = 2.0 * change / (B + std::sqrt(B * B - 4.0 * d * d * E * change));
  const double beta = z.imag() / (dt * turn);
  return {z.real() / dt - beta * rate, beta};
}

}  // namespace clatter::dynamics
