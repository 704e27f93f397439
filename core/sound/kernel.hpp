// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The free field of a point source.
#include <cmath>
#include <numbers>

#include "core/sound/space.hpp"

namespace clatter::sound {

/// G = exp(-i k r) / (4 pi r) [1/m], and its slope over distance, -G'(r) / r = (i k r + 1) G / r^2
/// [1/m3]; the derivative along n at y, as seen from x, is slope * n . (x - y).
struct Kernel {
  Complex g, slope;
};

inline Kernel kernel(double k, double r) {
  const double phase = k * r;
  const Complex g = Complex(std::cos(phase), -std::sin(phase)) / (4.0 * std::numbers::pi * r);
  return {g, Complex(g.real() - g.imag() * phase, g.imag() + g.real() * phase) / (r * r)};
}

}  // namespace clatter::sound
