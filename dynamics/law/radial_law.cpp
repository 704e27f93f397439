// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/law/radial_law.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

double RadialLaw::blend() const { return std::max(0.1 * clearance, 1e-7); }

double RadialLaw::force(double e) const {
  const double x = e - clearance;
  double beyond = 0.0;
  if (x > 0.0) {
    const double w = blend();
    if (exponent > 1.0) {
      beyond = std::pow(x, exponent);
    } else {
      beyond = x < w ? x * x / (2.0 * w) : x - 0.5 * w;
    }
  }
  return soft_stiffness * e + stiffness * beyond;
}

double RadialLaw::slope(double e) const {
  const double x = e - clearance;
  double beyond = 0.0;
  if (x > 0.0) {
    beyond = exponent > 1.0 ? exponent * std::pow(x, exponent - 1.0) : std::min(x / blend(), 1.0);
  }
  return soft_stiffness + stiffness * beyond;
}

double RadialLaw::energy(double e) const {
  const double x = e - clearance;
  double beyond = 0.0;
  if (x > 0.0) {
    const double w = blend();
    if (exponent > 1.0) {
      beyond = std::pow(x, exponent + 1.0) / (exponent + 1.0);
    } else if (x < w) {
      beyond = x * x * x / (6.0 * w);
    } else {
      // w^2 / 6 up to w, then the integral of x - w / 2.
      beyond = w * w / 6.0 + 0.5 * (x * x - w * w) - 0.5 * w * (x - w);
    }
  }
  return 0.5 * soft_stiffness * e * e + stiffness * beyond;
}

}  // namespace clatter::dynamics
