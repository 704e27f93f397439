// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/coil_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::dynamics {

double SpringWire::stiffness() const {
  return shear_modulus * std::pow(wire, 4) / (8.0 * std::pow(diameter, 3) * turns);
}

double SpringWire::mass() const {
  return std::numbers::pi * std::numbers::pi * wire * wire * diameter * turns * density / 4.0;
}

double CoilSpringSpec::surge() const { return 0.5 * std::sqrt(stiffness / mass); }

CoilLaw::CoilLaw(const CoilSpringSpec& spec, double share, bool is_end)
    : is_end_(is_end),
      force_(spec.force),
      stiffness_(spec.stiffness / share),
      damping_(stiffness_ * spec.damping / (std::numbers::pi * spec.surge())),
      gap_(spec.to_solid * share),
      clash_stiffness_(spec.clash_stiffness) {
  const double both = spec.mass / (2.0 * spec.masses);  // two masses against each other
  clash_damping_ = 2.0 * spec.clash_damping * std::sqrt(clash_stiffness_ * both);
}

CoilForce CoilLaw::at(double change, double rate) const {
  CoilForce law;
  double elastic = force_ - stiffness_ * change;
  double slope = -stiffness_;
  if (is_end_ && elastic < 0.0) elastic = slope = 0.0;
  law.force = elastic - damping_ * rate;
  law.by_length = slope;
  law.by_rate = -damping_;
  law.stored = 0.5 * elastic * elastic / stiffness_;
  const double depth = -change - gap_;
  if (depth > 0.0) {
    const double touch = clash_stiffness_ * depth;
    const double x = std::min(depth / kDampedDepth, 1.0);
    const double c = clash_damping_ * x * x * (3.0 - 2.0 * x);
    const double pushed = touch - c * rate;
    elastic += touch;
    law.stored += 0.5 * touch * depth;
    if (pushed > 0.0) {
      law.force += pushed;
      const double c_slope = clash_damping_ * 6.0 * x * (1.0 - x) / kDampedDepth;
      law.by_length += -clash_stiffness_ + c_slope * rate;
      law.by_rate -= c;
    }
  }
  if (is_end_ && law.force < 0.0) law.force = law.by_length = law.by_rate = 0.0;
  law.lost = (elastic - law.force) * rate;
  return law;
}

std::vector<CoilLaw> coil_laws(const CoilSpringSpec& spec) {
  std::vector<CoilLaw> laws;
  const double share = 1.0 / spec.masses;
  laws.emplace_back(spec, 0.5 * share, true);
  for (int i = 1; i < spec.masses; ++i) laws.emplace_back(spec, share, false);
  laws.emplace_back(spec, 0.5 * share, true);
  return laws;
}

}  // namespace clatter::dynamics
