// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/flow_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::dynamics {

double leak_conductance(const LeakGap& gap, double diameter, double viscosity) {
  const double h = gap.height, e = gap.eccentricity;
  return std::numbers::pi * diameter * h * h * h * (1.0 + 1.5 * e * e) /
         (12.0 * viscosity * gap.length);
}

VolumeFlow orifice_flow(double area, double density, double laminar, double pressure) {
  const double square = pressure * pressure + laminar * laminar;
  const double per_pressure = area * std::sqrt(2.0 / density) / std::sqrt(std::sqrt(square));
  return {per_pressure * pressure, per_pressure * (1.0 - 0.5 * pressure * pressure / square), 0.0};
}

VolumeFlow relief_flow(const ReliefSpec& relief, double pressure) {
  const double above = pressure - relief.opening;
  if (relief.opening <= 0.0 || above <= 0.0) return {};
  const double rounded = 0.05 * relief.opening;
  if (above >= rounded) return {relief.gradient * (above - 0.5 * rounded), relief.gradient, 0.0};
  return {0.5 * relief.gradient * above * above / rounded, relief.gradient * above / rounded, 0.0};
}

SmoothStep smooth_step(double u) {
  const double x = std::clamp(u, 0.0, 1.0);
  return {x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x)};
}

}  // namespace clatter::dynamics
